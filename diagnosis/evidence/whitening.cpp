#include "diagnosis/evidence/whitening.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "common/linalg/symmetric_eigen.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// Of the variance of errors, what is not alike even between neighbours: short waves are not believed to be as small as
/// the exponential has them.
constexpr double nugget = 0.15;
/// Of the variance of the longest wave. Waves of a Gaussian and of an exponential correlation of the same length, whose
/// longest are equal, differ by less than two where the exponential's are above `coarse`.
constexpr double finest = 0.05, coarse = 0.2;

double alike(double apart, double range) {
  return range > 0 ? std::exp(-apart / range) : apart > 0 ? 0 : 1;
}

/// Correlation of the errors of two groups of data of one source [rows x columns], without the nugget.
MatrixXd correlation(const Evidence& evidence, const Noise& noise, const std::vector<Index>& rows,
                     const std::vector<Index>& columns) {
  MatrixXd all(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  for (Index j = 0; j < all.cols(); ++j)
    for (Index i = 0; i < all.rows(); ++i) {
      const Index a = rows[static_cast<std::size_t>(i)], b = columns[static_cast<std::size_t>(j)];
      const double apart = (evidence.places().col(a) - evidence.places().col(b)).norm(),
                   later = std::abs(evidence.times()[static_cast<std::size_t>(a)] -
                                    evidence.times()[static_cast<std::size_t>(b)]);
      all(i, j) = a == b ? 1 : alike(apart, noise.correlation_length) * alike(later, noise.correlation_time);
    }
  return all;
}

}  // namespace

Whitening::Whitening(const Evidence& evidence, const EffectProblem& problem) {
  add_groups(evidence, problem, problem.training, false);
  add_groups(evidence, problem, problem.held_out, true);
  add_chains(evidence);
}

void Whitening::add_groups(const Evidence& evidence, const EffectProblem& problem, const std::vector<Index>& rows,
                           bool held_out) {
  std::map<std::tuple<std::size_t, int>, std::vector<Index>> parted;
  std::size_t part = 0;
  for (const Index i : rows) {
    while (i >= evidence.parts()[part].first + evidence.parts()[part].count) ++part;
    parted[{part, evidence.components()[static_cast<std::size_t>(i)]}].push_back(i);
  }
  for (const auto& [key, own] : parted) {
    const Evidence::Part& of = evidence.parts()[std::get<0>(key)];
    const Noise noise = evidence.noise(of);
    Group group{own,
                held_out,
                evidence.source(of).facts().held_out,
                of.source,
                of.frame.series,
                std::get<1>(key),
                evidence.moment_of(of),
                {},
                {},
                count_};
    const VectorXd weight = problem.independent(own).cwiseSqrt();
    MatrixXd together = (1 - nugget) * correlation(evidence, noise, own, own);
    together.diagonal().setOnes();
    const auto [variances, waves] = symmetric_eigen(weight.asDiagonal() * together * weight.asDiagonal());
    const Index kept = (variances.array() > finest * variances.maxCoeff()).count();
    group.variance = variances.tail(kept) / variances.maxCoeff();
    group.modes = variances.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal() * waves.rightCols(kept).transpose() *
                  weight.asDiagonal() / noise.deviation;
    count_ += kept;
    groups_.push_back(std::move(group));
  }
}

void Whitening::add_chains(const Evidence& evidence) {
  std::map<std::tuple<std::size_t, int, int>, std::vector<std::size_t>> chained;
  for (std::size_t k = 0; k < groups_.size(); ++k)
    chained[{groups_[k].source, groups_[k].series, groups_[k].component}].push_back(k);
  for (const auto& [key, own] : chained)
    if (own.size() > 1 && evidence.noise_of(std::get<0>(key)).correlation_time > 0)
      chains_.push_back({own, covariance_of(evidence, own).llt().matrixL()});
}

MatrixXd Whitening::covariance_of(const Evidence& evidence, const std::vector<std::size_t>& groups) const {
  std::vector<Index> first{0};
  for (const std::size_t k : groups) first.push_back(first.back() + groups_[k].modes.rows());
  MatrixXd all = MatrixXd::Identity(first.back(), first.back());
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Group &a = groups_[groups[i]], &b = groups_[groups[j]];
      const Noise noise = evidence.noise_of(a.source);
      all.block(first[i], first[j], a.modes.rows(), b.modes.rows()) =
          (1 - nugget) * std::pow(noise.deviation, 2) *
          (a.modes * correlation(evidence, noise, a.rows, b.rows) * b.modes.transpose());
    }
  return all.selfadjointView<Eigen::Lower>();
}

std::vector<NoiseBand> Whitening::bands() const {
  constexpr double half = 0.5;
  std::vector<NoiseBand> all;
  for (const Group& group : groups_)
    for (const double variance : group.variance) all.push_back({group.source, variance > half});
  return all;
}

void Whitening::widen(const VectorXd& larger) {
  for (Group& group : groups_)
    group.modes = larger.segment(group.first, group.modes.rows()).cwiseInverse().asDiagonal() * group.modes;
}

MatrixXd Whitening::operator()(const MatrixXd& data) const {
  MatrixXd white(count_, data.cols());
  if (data.cols() == 0) return white;  // which has no place in memory whose rows could be named
  for (const Group& group : groups_)
    white.middleRows(group.first, group.modes.rows()) = group.modes * data(group.rows, Eigen::all);
  for (const Chain& chain : chains_) {
    std::vector<Index> rows;
    for (const std::size_t k : chain.groups)
      for (Index i = 0; i < groups_[k].modes.rows(); ++i) rows.push_back(groups_[k].first + i);
    MatrixXd own = white(rows, Eigen::all);
    chain.factor.triangularView<Eigen::Lower>().solveInPlace(own);
    white(rows, Eigen::all) = own;
  }
  return white;
}

EffectProblem Whitening::operator()(EffectProblem problem) const {
  problem.residual = (*this)(problem.residual);
  problem.changes = (*this)(problem.changes);
  problem.allowed = (*this)(problem.allowed);
  problem.patterns = (*this)(problem.patterns);
  problem.precision = VectorXd::Ones(count_);
  problem.independent = VectorXd::Zero(count_);
  problem.training.clear(), problem.held_out.clear(), problem.sealed.clear(), problem.block.clear(),
      problem.moment.clear();
  for (const Group& group : groups_)
    for (Index k = 0; k < group.modes.rows(); ++k) {
      const Index i = group.first + k;
      (group.held_out ? problem.held_out : problem.training).push_back(i);
      if (group.sealed) problem.sealed.push_back(i);
      problem.independent(i) = group.variance(k) > coarse ? 1 : 0;
      problem.block.push_back(static_cast<int>(i));
      problem.moment.push_back(group.moment);
    }
  return problem;
}

}  // namespace tether
