/// The reference renderer: what the device must agree with. Written from the equations, in double
/// precision, with no code of the device but the definitions of random numbers and of what counts
/// as a mishap, so that with the same seed both trace the same paths up to rounding.
#pragma once

#include "scene/path_event.h"
#include "shared/health.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace tyndall::reference {

/// Sums over a range of samples, for each pixel of scene.film.bounds, row by row: rgb is the sum of
/// filter weight * radiance, w the sum of filter weights. The pixel's colour is rgb / w.
using PixelSums = std::vector<glm::dvec4>;

class ReferenceRenderer {
  public:
    /// Keeps a reference to the scene.
    /// @throws Error failed if the ray tracing library cannot be set up.
    explicit ReferenceRenderer(const Scene& scene);
    ~ReferenceRenderer();

    /// Renders the samples first_sample ... first_sample + sample_count - 1 of every pixel, on all
    /// cores. The result is a pure function of the scene and the range, to the last bit.
    ///
    /// @param keep_going  Called now and then by the calling thread, with the share done in [0, 1];
    ///                    false stops. What was done until then is dropped.
    /// @return            Empty if it was stopped.
    PixelSums render(std::uint32_t first_sample, std::uint32_t sample_count,
                     const std::function<bool(double share_done)>& keep_going = {});

    /// Traces the sample of the pixel (x, y) of the picture. Does not count for health().
    Replay replay(int x, int y, std::uint32_t sample) const;

    /// What went wrong so far.
    shared::Health health() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace tyndall::reference
