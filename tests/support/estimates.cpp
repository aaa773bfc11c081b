#include "support/estimates.h"

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
    Rgb sum(0), sum_of_squares(0);
    for (std::uint32_t b = 0; b < batches; ++b) {
        glm::dvec4 total(0);
        for (const glm::dvec4& pixel : renderer.render(b * samples_per_batch, samples_per_batch))
            total += pixel;
        const Rgb mean = Rgb(total) / total.w;
        sum += mean;
        sum_of_squares += mean * mean;
    }
    const double n = batches;
    const Rgb mean = sum / n;
    const Rgb variance = glm::max(Rgb(0), sum_of_squares / n - mean * mean) * (n / (n - 1));
    return {mean, glm::sqrt(variance / n)};
}

} // namespace tyndall::support
