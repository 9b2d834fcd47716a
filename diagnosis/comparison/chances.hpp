#pragma once

#include <vector>

namespace tether {

/// Probability that a standard normal number exceeds z.
double normal_tail(double z);

/// Probability that Student's t with n degrees of freedom exceeds t.
double student_tail(double t, int n);

/// Deviations on either side of the mean between which a normal number lies with 95 %.
inline constexpr double two_sided_95 = 1.96;

/// z with the probability p below it, 0 < p < 1, standard normal.
double normal_quantile(double p);

/// The mean of n squared standard normal numbers that lies z standard deviations up, by Wilson and Hilferty: n real.
double mean_square_quantile(double n, double z);

/// Probability that the sum of n squared standard normal numbers exceeds x.
double chi_square_tail(double x, int n);

/// The same for the gain of a fit of n amplitudes that cannot be negative: at most this, whatever their correlation
/// (Perlman, Ann. Math. Statist. 40, 1969); exact for one. (D.10)
double one_sided_tail(double x, int n);

/// Probabilities corrected for their number, so that one of them is below alpha by chance in alpha of all cases at most
/// (Holm, Scand. J. Statist. 6, 1979).
std::vector<double> holm(const std::vector<double>& p);

}  // namespace tether
