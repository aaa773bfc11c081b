/// How wrong pictures are, and how much of that is bias, how much noise.
///
/// All quantities are squared errors over pixels and channels, relative to the sum of squares of
/// the reference; their expectations are what they are named after, exactly (no plug-in). So a
/// bias that is too small to be told can come out negative: look at sd.
///
/// Standard deviations take pixels as independent, which they are (shared/random.h), and channels
/// as fully dependent, so that they are too large if anything. They are distribution-free
/// (U-statistics; Hoeffding 1948), apart from the share of a reference of a single part.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tyndall::study {

/// Linear RGB by pixel, row by row.
using Picture = std::vector<glm::dvec3>;

/// Independent pictures of the same expectation that a technique makes. Four at least: the variance
/// of a squared bias is a polynomial of degree four.
constexpr std::size_t kRuns = 4;

struct Estimate {
    double value = 0;
    double sd = 0; ///< Standard deviation of value.
};

/// What errors are measured from.
struct Reference {
    Picture mean;
    Picture variance; ///< Of mean.
    /// Independent pictures whose average is mean: kRuns of them, or none if it came as a file
    /// without them.
    std::vector<Picture> parts;

    double power() const;   ///< Sum over pixels and channels of mean^2, noise taken off.
    Estimate error() const; ///< Squared relative error of mean.
};

/// kRuns parts of the same weight.
Reference make_reference(std::vector<Picture> parts);

struct ErrorSplit {
    Estimate total; ///< Of a single run: bias + noise.
    Estimate noise;
    Estimate bias;
};

/// @param runs       kRuns pictures, independent of each other and of the reference.
/// @param reference  of as many pixels; not black.
ErrorSplit split_error(std::span<const Picture> runs, const Reference& reference);

/// Squared relative noise of a single run, alone.
Estimate measure_noise(std::span<const Picture> runs, double power);

/// Mean over pixels and channels of the runs, over that of the reference, less 1.
Estimate brightness_error(std::span<const Picture> runs, const Reference& reference);

/// The average of pictures.
Picture average(std::span<const Picture> pictures);

} // namespace tyndall::study
