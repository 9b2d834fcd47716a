/// What the search rests on: probabilities, scores beside allowed errors, and admissible amplitudes.
#include "diagnosis/evidence/scores.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/evidence/effect_problem.hpp"

namespace tether {
namespace {

TEST(Chances, AreThoseOfTheTables) {
  EXPECT_NEAR(normal_tail(1.959964), 0.025, 1e-7);
  EXPECT_NEAR(chi_square_tail(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(5.991465, 2), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(7.814728, 3), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(14.06714, 7), 0.05, 1e-6);
  EXPECT_NEAR(one_sided_tail(2.705543, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(80, 2), std::exp(-40), 1e-6 * std::exp(-40)) << "far out too";
  EXPECT_EQ(chi_square_tail(0, 3), 1);
  EXPECT_EQ(chi_square_tail(infinite, 3), 0);
  EXPECT_TRUE(std::isnan(chi_square_tail(std::nan(""), 3)));
  const std::vector<double> q = holm({0.04, 0.01, 0.03});
  EXPECT_DOUBLE_EQ(q[1], 0.03);
  EXPECT_DOUBLE_EQ(q[2], 0.06);
  EXPECT_DOUBLE_EQ(q[0], 0.06) << "not below a smaller p's";
}

TEST(Scores, TakeOutWhatIsAllowed) {
  const MatrixXd changes = MatrixXd::Random(30, 3), allowed = MatrixXd::Random(30, 2);
  const VectorXd precision = VectorXd::Random(30).cwiseAbs(), residual = VectorXd::Random(30);
  const VectorXd deviations = (VectorXd(2) << 0.7, 2.0).finished();
  const MatrixXd covariance = MatrixXd(precision.cwiseInverse().asDiagonal()) +
                              allowed * deviations.cwiseAbs2().asDiagonal() * allowed.transpose();
  const Scores scores = scores_of(AllowedErrors(precision, allowed, deviations), changes, residual);
  EXPECT_LT((scores.information - changes.transpose() * covariance.inverse() * changes).norm(),
            1e-9 * scores.information.norm());
  EXPECT_LT((scores.response - changes.transpose() * covariance.inverse() * residual).norm(),
            1e-9 * scores.response.norm());
  const AllowedErrors anything(precision, allowed, VectorXd::Constant(2, infinite));
  EXPECT_LT(anything(allowed).norm(), 1e-6 * (precision.asDiagonal() * allowed).norm())
      << "orthogonal to what may be anything";
}

TEST(Scores, OneSidedAmplitudesAreNotNegative) {
  const MatrixXd information = (MatrixXd(2, 2) << 2, 1, 1, 2).finished();
  const VectorXd response = (VectorXd(2) << 3, -1).finished();
  EXPECT_LT(best_fit(information, response, {false, false}).amplitudes(1), 0);
  const Fit fit = best_fit(information, response, {true, true});
  EXPECT_DOUBLE_EQ(fit.amplitudes(0), 1.5);
  EXPECT_DOUBLE_EQ(fit.amplitudes(1), 0);
  EXPECT_DOUBLE_EQ(fit.gain, 4.5);
}

TEST(Amplitude, StaysShortOfItsBounds) {
  const Amplitude bounded{"stiffness", "", "1", false, 0.5, 2, false, 0, 4};
  EXPECT_DOUBLE_EQ(bounded.value(1), 3);
  EXPECT_DOUBLE_EQ(bounded.value(5), 4 - 0.02);
  EXPECT_NEAR(bounded.value(-5), 0.02, 1e-12);
  const Amplitude doubling{"factor", "", "1", false, 0.5, 3, true};
  EXPECT_DOUBLE_EQ(doubling.value(1), 6);
  EXPECT_DOUBLE_EQ(doubling.value(9), 3 * 512) << "however much that is in scales";
  EXPECT_DOUBLE_EQ(doubling.limited(-19), -10) << "a thousandth";
  const Amplitude both{"factor", "", "1", false, 0.5, 3, true, 1, 6};
  EXPECT_DOUBLE_EQ(both.value(9), 6 - 0.03);
  EXPECT_DOUBLE_EQ(both.value(-9), 1.02);
  const Amplitude at_bound{"share", "", "1", true, 0.5, 0, false, 0, 1};
  EXPECT_DOUBLE_EQ(at_bound.limited(-1), 0);
}

}  // namespace
}  // namespace tether
