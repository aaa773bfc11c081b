#include "support/estimates.h"

#include <numeric>

namespace tyndall::support {

std::vector<Rgb> colors(const reference::PixelSums& sums) {
    std::vector<Rgb> result;
    for (const glm::dvec4& sum : sums)
        result.push_back(Rgb(sum) / sum.w);
    return result;
}

std::vector<Rgb> render(const Scene& scene, std::uint32_t samples) {
    return colors(reference::ReferenceRenderer(scene).render(0, samples));
}

Estimate image_mean(const Scene& scene, std::uint32_t batches, std::uint32_t samples_per_batch) {
    reference::ReferenceRenderer renderer(scene);
    std::vector<Rgb> means;
    for (std::uint32_t b = 0; b < batches; ++b) {
        glm::dvec4 total(0);
        for (const glm::dvec4& pixel : renderer.render(b * samples_per_batch, samples_per_batch))
            total += pixel;
        means.push_back(Rgb(total) / total.w);
    }
    const double n = batches;
    const Rgb mean = std::accumulate(means.begin(), means.end(), Rgb(0)) / n;
    // From the deviations: the difference of squares would lose spreads below 1e-8 of the mean.
    Rgb variance(0);
    for (const Rgb& m : means)
        variance += (m - mean) * (m - mean) / (n - 1);
    return {mean, glm::sqrt(variance / n)};
}

} // namespace tyndall::support
