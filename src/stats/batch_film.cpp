#include "stats/batch_film.h"

#include <bit>

namespace tyndall::stats {

void BatchFilm::fold(const std::vector<glm::dvec4>& batch, double samples) {
    const double before = contrasts_.samples;
    const double scale = before / (samples * (before + samples));
    for (std::size_t i = 0; i < batch.size(); ++i) {
        const glm::dvec3 value(batch[i]);
        // With filters that have negative parts, the weights of a few samples can cancel.
        if (before > 0 && sums_[i].w >= 0.5 * before) {
            const glm::dvec3 d = value - glm::dvec3(sums_[i]) * (batch[i].w / sums_[i].w);
            const double square = glm::dot(d, d) * scale;
            residuals_[i] += d * d * scale;
            error_sums_.variances += samples * scale * d * d;
            error_sums_.covariances +=
                samples * scale * glm::dvec3(d.x * d.y, d.x * d.z, d.y * d.z);
            error_sums_.squares += square * square;
        }
        if (samples == 1 && batch[i].w > 0) {
            const auto luminance =
                static_cast<float>(glm::dot(value, glm::dvec3(shared::LUMINANCE)) / batch[i].w);
            ++histogram_[shared::sample_bin(
                std::bit_cast<std::uint32_t>(std::max(luminance, 0.F)))];
        }
        sums_[i] += batch[i];
    }
    contrasts_.add(samples);
}

std::optional<ErrorEstimate> BatchFilm::error() const {
    ErrorSums sums = error_sums_;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].w == 0) continue;
        const glm::dvec3 mean = glm::dvec3(sums_[i]) / sums_[i].w;
        const double residual = residuals_[i].x + residuals_[i].y + residuals_[i].z;
        sums.residual_squares += residual * residual;
        sums.mean_squares += glm::dot(mean, mean);
        sums.mean_residuals += glm::dot(mean, mean) * residual;
    }
    return estimate_error(contrasts_, sums, static_cast<double>(sums_.size()));
}

Image BatchFilm::image(int width) const {
    Image image(width, static_cast<int>(sums_.size()) / width,
                {"R", "G", "B", "variance.R", "variance.G", "variance.B"});
    const double divisor = contrasts_.count * contrasts_.samples;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].w == 0) continue;
        for (int c = 0; c < 3; ++c) {
            image.pixels[i * 6 + c] = static_cast<float>(sums_[i][c] / sums_[i].w);
            if (divisor > 0)
                image.pixels[i * 6 + 3 + c] = static_cast<float>(residuals_[i][c] / divisor);
        }
    }
    return image;
}

} // namespace tyndall::stats
