/// Functions of shaders/lib, evaluated on the device.
#pragma once

#include "gpu/commands.h"
#include "shared/records.h"
#include "shared/selftest_functions.h"

#include <glm/glm.hpp>
#include <vector>

namespace tyndall::selftest {

class Evaluator {
  public:
    static constexpr std::uint32_t most = 1u << 14; ///< Arguments of one call.

    explicit Evaluator(const gpu::Context& context);

    /// @param function   shared::FUNCTION_*
    /// @param arguments  one texel each, at most `most`; words bit by bit.
    /// @return the value for each.
    std::vector<glm::vec4> evaluate(std::uint32_t function,
                                    const std::vector<glm::vec4>& arguments);

  private:
    const gpu::Context* context_;
    gpu::Buffer arguments_, values_, unused_paths_, unused_pieces_, unused_voxels_, control_,
        queues_;
    gpu::Descriptors descriptors_;
    gpu::Stage stage_;
};

} // namespace tyndall::selftest
