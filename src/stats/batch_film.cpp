#include "stats/batch_film.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tyndall::stats {

void BatchFilm::fold(const std::vector<glm::dvec4>& batch, double samples) {
    const double before = contrasts_.samples, pairs = contrasts_.pairs;
    const double weight = contrasts_.add(batches_++, samples);
    const bool ends_pair = contrasts_.pairs > pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
        Spread& spread = spreads_[i];
        glm::dvec3 d(0);
        // With filters that have negative parts, the weights of a few samples can cancel.
        if (before > 0 && sums_[i].w >= 0.5 * before) {
            d = glm::dvec3(batch[i]) - glm::dvec3(sums_[i]) * (batch[i].w / sums_[i].w);
            add_contrast(spread, d, weight, before / (samples * (before + samples)));
            // The residual of the batch before, about the mean that this one has.
            const glm::dvec3 other = spread.last * ((before - samples) / before);
            if (ends_pair) add_pair(spread, (d - other) / std::sqrt(2 * samples));
        }
        spread.last = d;
        if (samples == 1) count_sample(batch[i]);
        sums_[i] += batch[i];
    }
}

void BatchFilm::add_contrast(Spread& spread, const glm::dvec3& d, double weight, double scale) {
    const double square = glm::dot(d, d) * scale;
    spread.residual += d * d * scale;
    spread.weighted += weight * square;
    error_sums_.variances += weight * scale * d * d;
    error_sums_.covariances += weight * scale * glm::dvec3(d.x * d.y, d.x * d.z, d.y * d.z);
    error_sums_.squares += square * square;
}

void BatchFilm::add_pair(Spread& spread, const glm::dvec3& difference) {
    const double square = glm::dot(difference, difference);
    spread.pairs += square;
    error_sums_.pair_squares += square * square;
}

void BatchFilm::count_sample(const glm::dvec4& value) {
    if (value.w <= 0) return;
    const auto luminance =
        static_cast<float>(glm::dot(glm::dvec3(value), glm::dvec3(shared::LUMINANCE)) / value.w);
    ++histogram_[shared::sample_bin(std::bit_cast<std::uint32_t>(std::max(luminance, 0.F)))];
}

std::optional<ErrorEstimate> BatchFilm::error() const {
    ErrorSums sums = error_sums_;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        if (sums_[i].w == 0) continue;
        const Spread& spread = spreads_[i];
        const glm::dvec3 mean = glm::dvec3(sums_[i]) / sums_[i].w;
        sums.pair_residual_squares += spread.pairs * spread.pairs;
        sums.weighted_squares += spread.weighted * spread.weighted;
        sums.mean_squares += glm::dot(mean, mean);
        sums.mean_residuals += glm::dot(mean, mean) * spread.weighted;
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
                image.pixels[i * 6 + 3 + c] = static_cast<float>(spreads_[i].residual[c] / divisor);
        }
    }
    return image;
}

} // namespace tyndall::stats
