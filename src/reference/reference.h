/// The reference renderer: what the device must agree with. Written from the equations, in double
/// precision, with no code of the device but the definition of random numbers, so that with the
/// same seed both trace the same paths up to rounding.
#pragma once

#include "scene/scene.h"

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

    /// Paths so far whose radiance was not finite; they count as black.
    std::uint64_t dropped_paths() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace tyndall::reference
