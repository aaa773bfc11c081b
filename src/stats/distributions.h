/// Tail probabilities, accurate to about 1e-12 of their value down to the smallest double.
#pragma once

namespace tyndall::stats {

/// P(|Z| >= |z|) of a standard normal Z.
double normal_two_sided(double z);

/// P(|T| >= |t|) of Student's T; dof > 0. 0 for infinite t.
double student_two_sided(double t, double dof);

/// The t with student_two_sided(t, dof) = p; 1e-6 <= p < 1, dof >= 0.5.
double student_quantile(double p, double dof);

/// P(X >= x) of a chi-squared X; x >= 0, dof > 0.
double chi_squared_tail(double x, double dof);

/// The probability that the least of n independent p-values is p or less (Sidak 1967).
double least_of(double p, double n);

} // namespace tyndall::stats
