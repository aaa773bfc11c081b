/// How wrong an image still is, as its own batches tell.
///
/// Batch b holds the sums of m samples, after N earlier ones. For each pixel and channel
///
///     c_b = (sum of the batch - m * mean so far) * sqrt(N / (m (N + m)))
///
/// has the variance of a sample as the expectation of its square, and these contrasts are
/// uncorrelated: with each other and with c_0 = sqrt(n) (mean of all n samples - truth) (Helmert
/// 1876). So the error that the image really has, sum c_0^2 / n, is predicted by the mean of
/// D_b = sum c_b^2, and the spread of that prediction follows from sums of D_b and D_b^2 over
/// pixels, which are independent of each other. No pixel is looked at alone.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace tyndall::stats {

/// What the sizes of the batches decide. All sums are over batches after the first.
struct BatchContrasts {
    double samples = 0;       ///< n, the first batch included.
    double count = 0;         ///< Contrasts: batches but one.
    double weight = 0;        ///< sum m
    double weight_square = 0; ///< sum m^2
    /// A fourth cumulant k of a sample adds k fourth to sum Var(c_b^2), and k shared to the sum of
    /// Cov(c_b^2, c_c^2) over ordered pairs; and the same with weights m.
    double fourth = 0, shared = 0;
    double weighted_fourth = 0, weighted_shared = 0;

    /// The next batch, of so many samples (> 0).
    void add(double batch_samples);
};

/// Sums over pixels p (and batches b). D_bp is the square of contrast b summed over the channels.
struct ErrorSums {
    glm::dvec3 variances{0};     ///< sum m_b c_b^2 of R, G, B
    glm::dvec3 covariances{0};   ///< sum m_b c_b c_b' of RG, RB, GB
    double squares = 0;          ///< sum D_bp^2
    double residual_squares = 0; ///< sum over p of R_p^2, R_p = sum over b of D_bp
    double mean_squares = 0;     ///< sum |mean_p|^2
    double mean_residuals = 0;   ///< sum |mean_p|^2 R_p
};

/// Errors relative to the image: 0.01 is 1 %.
struct ErrorEstimate {
    double relative_rmse = 0; ///< sqrt(sum of variances of pixel means / sum of squared means)
    double low = 0;           ///< 95 % interval of the error that this image has:
    double high = 0;          ///< sqrt(sum (mean - truth)^2 / sum truth^2). Finite.
};

/// The estimate after the batches, or none: a single batch, a black image, too few pixels and
/// batches for a bound, sums that are not finite.
///
/// Weights m make the difference between stated and real error free of the fourth cumulant, but for
/// its last few per cent; what is left is the sum over pixels of 2 tr(C^2), C being the covariance
/// of the channels, taken as tr(C)^2 times what tr(C^2) / tr(C)^2 is for the whole image. The
/// interval is that of an F distribution, in Paulson's (1942) approximation.
///
/// @param pixels  of the image
std::optional<ErrorEstimate> estimate_error(const BatchContrasts& contrasts, const ErrorSums& sums,
                                            double pixels);

} // namespace tyndall::stats
