/// The bar for the wavefront: homogeneous-cube in one kernel that knows nothing else
/// (fused_cube.comp).
#pragma once

#include "gpu/commands.h"
#include "shared/records.h"

namespace tyndall::bench {

class FusedCube {
  public:
    /// Pictures of size x size pixels.
    FusedCube(const gpu::Context& context, std::uint32_t size);
    /// Renders so many samples per pixel and waits; returns the mean of the picture.
    void render(std::uint32_t samples, std::uint32_t seed);
    double read_mean() const;

  private:
    const gpu::Context& context_;
    shared::PushConstants push_{};
    gpu::Buffer unused_, film_;
    gpu::Descriptors descriptors_;
    gpu::Stage stage_;
    gpu::Commands commands_;
};

} // namespace tyndall::bench
