/// How wrong an image still is, as its own batches tell.
///
/// Batch b holds the sums of m samples, after N earlier ones. For each pixel and channel
///
///     c_b = (sum of the batch - m * mean so far) * sqrt(N / (m (N + m)))
///
/// has the variance of a sample as the expectation of its square, and these contrasts are
/// uncorrelated: with each other and with c_0 = sqrt(n) (mean of all n samples - truth) (Helmert
/// 1876). So c_0^2, the error that this image really has, is predicted by V = sum w_b c_b^2 / sum
/// w_b. With weights that follow from those of the batch before (primed) as
///
///     w = w' N' m / (m' (N - m)),
///
/// V holds the square of each sample's deviation 1 / n times, as c_0^2 / n does: rare bright
/// samples that are in the image are in both, and V - c_0^2 is a sum of products of different
/// samples. Its variance is 2 tr(C^2) of each pixel, C being the covariance of a sample's channels,
/// whatever the higher moments, if there are any. For the same reason |mean|^2 - V / n is free of
/// squares.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

namespace tyndall::stats {

/// What the sizes of the batches decide. All sums are over batches after the first.
struct BatchContrasts {
    double samples = 0;       ///< n, the first batch included.
    double last = 0;          ///< Samples of the last batch.
    double count = 0;         ///< Contrasts: batches but one.
    double pairs = 0;         ///< Batches 2 k and 2 k + 1 of one size, both here.
    double weight = 0;        ///< sum w
    double weight_square = 0; ///< sum w^2
    double fourth = 0;        ///< A fourth cumulant k of a sample adds k fourth to sum Var(c_b^2).

    /// Adds the next batch, of so many samples (> 0), and tells its weight.
    /// @param batch  its number in the schedule (shared/schedule.h)
    double add(std::uint32_t batch, double batch_samples);
};

/// Sums over pixels p. For each, D_b is the square of contrast b summed over the channels, and g_k
/// that of the difference of the batches of pair k, over twice their samples.
struct ErrorSums {
    glm::dvec3 variances{0};          ///< sum w_b c_b^2 of R, G, B
    glm::dvec3 covariances{0};        ///< sum w_b c_b c_b' of RG, RB, GB
    double squares = 0;               ///< sum D_b^2
    double pair_squares = 0;          ///< sum g_k^2
    double pair_residual_squares = 0; ///< sum G^2, G = sum g_k
    double weighted_squares = 0;      ///< sum W^2, W = sum w_b D_b
    double mean_squares = 0;          ///< sum |mean|^2
    double mean_residuals = 0;        ///< sum |mean|^2 W
};

/// Errors relative to the image: 0.01 is 1 %.
struct ErrorEstimate {
    double relative_rmse = 0; ///< sqrt(sum of variances of pixel means / sum of squared means)
    double low = 0;           ///< 95 % interval of the error that this very image has:
    double high = 0;          ///< sqrt(sum (mean - truth)^2 / sum truth^2). May be infinite.
    /// Relative standard deviation of relative_rmse^2 from image to image.
    double variation = 0;
};

/// The estimate after the batches, or none: a single batch, a mean that is all but noise, sums that
/// are not finite. Batches that are all alike have no error, those of a black image included. There
/// is no upper end if too few pixels and batches, or too bright a sample, leave the brightness of
/// the image open.
///
/// What is covered is the error of this image, a random number, not its expectation. Not covered is
/// light that no sample has found yet. The interval is that of an F distribution, in Paulson's
/// (1942) approximation, with quantiles of Student's t for as many degrees of freedom as V has by
/// its own spread (Satterthwaite 1946).
///
/// @param pixels  of the image
std::optional<ErrorEstimate> estimate_error(const BatchContrasts& contrasts, const ErrorSums& sums,
                                            double pixels);

} // namespace tyndall::stats
