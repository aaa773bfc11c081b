/// Runs functions of shaders/lib and shaders/shared on the device.
///
/// A kernel is a small compute shader beside these tests. It reads texels from the binding of the
/// scene and writes texels to the binding of the film, so that the program's own descriptors and
/// loads serve.
#pragma once

#include "gpu/commands.h"
#include "shared/records.h"
#include "support/gpu_context.h"

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tyndall::shader_test {

using support::GpuTest;

/// What kernel.glsl calls by the same names.
struct Task {
    std::uint32_t function = 0; ///< Which of the kernel's functions to run.
    std::uint32_t variant = 0;  ///< 0: the library's; others: a wrong or naive one, as a control.
    std::uint32_t first = 0;    ///< Index of the first invocation.
    float number = 0;           ///< A parameter.
};

class Kernel {
  public:
    /// @param output_texels  most texels that a run writes.
    Kernel(const char* name, std::span<const std::uint32_t> spirv, std::uint32_t input_texels,
           std::uint32_t output_texels, const shared::Features& features = {});

    /// Runs `count` invocations, each of which reads what it likes of `input` and writes one Out.
    template<typename Out, typename In>
    std::vector<Out> run(const Task& task, const std::vector<In>& input, std::uint32_t count) {
        static_assert(sizeof(In) % 16 == 0 && sizeof(Out) % 16 == 0, "records are whole texels");
        std::vector<Out> output(count);
        run_bytes(task, std::as_bytes(std::span(input)), count,
                  std::as_writable_bytes(std::span(output)));
        return output;
    }
    template<typename Out>
    std::vector<Out> run(const Task& task, std::uint32_t count) {
        return run<Out>(task, std::vector<glm::vec4>{}, count);
    }

    /// The control block as the last run left it.
    shared::Control read_control() const;

    shared::PushConstants push{}; ///< Those fields that Task does not take are free.

  private:
    void run_bytes(const Task& task, std::span<const std::byte> input, std::uint32_t count,
                   std::span<std::byte> output);

    gpu::Buffer input_, output_, unused_paths_, unused_pieces_, unused_voxels_, control_, queues_;
    gpu::Descriptors descriptors_;
    gpu::Stage stage_;
};

} // namespace tyndall::shader_test
