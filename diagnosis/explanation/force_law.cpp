#include "diagnosis/explanation/force_law.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double convincing = 6;  ///< of BIC
constexpr std::size_t most_terms = 4;
constexpr double exact = 1e-6;  ///< of the force: a law that leaves less is not improved

struct Dictionary {
  std::vector<std::string> names;
  std::vector<bool> is_expression;
  MatrixXd columns;  ///< [n x terms]
};

Dictionary dictionary_of(const LocalMotion& m) {
  const Index n = m.displacement.size();
  const auto u = m.displacement.array(), v = m.velocity.array();
  Dictionary d;
  std::vector<VectorXd> columns;
  const auto add = [&](const char* name, const VectorXd& column, bool is_expression = true) {
    if (!(column.cwiseAbs().maxCoeff() > 0)) return;
    d.names.emplace_back(name);
    d.is_expression.push_back(is_expression);
    columns.push_back(column);
  };
  add("1", VectorXd::Ones(n));
  add("un", m.displacement);
  add("vn", m.velocity);
  add("acceleration", m.acceleration, false);
  add("pressure", m.pressure, false);
  add("un*abs(un)", u * u.abs());
  add("un^3", u.cube());
  add("vn*abs(vn)", v * v.abs());
  d.columns.resize(n, static_cast<Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) d.columns.col(static_cast<Index>(i)) = columns[i];
  return d;
}

/// Weighted least squares with some of the dictionary's terms.
struct LeastSquares {
  VectorXd coefficients;
  double left = 0;  ///< weighted square that remains
  LeastSquares(const MatrixXd& columns, const VectorXd& force, const std::vector<Index>& terms) {
    if (terms.empty()) {
      left = force.squaredNorm();
      return;
    }
    const MatrixXd chosen = columns(Eigen::all, terms);
    coefficients = chosen.colPivHouseholderQr().solve(force);
    left = (force - chosen * coefficients).squaredNorm();
  }
};

/// "-1.2e+05*un - 3e+03*vn"
std::string formula_of(const std::vector<LawTerm>& terms) {
  std::string text;
  for (const LawTerm& term : terms) {
    const bool negative = term.coefficient < 0;
    const std::string sign = text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    text += sign + fmt::format("{:.4g}", std::abs(term.coefficient)) + (term.name == "1" ? "" : "*" + term.name);
  }
  return text.empty() ? "0" : text;
}

}  // namespace

ForceLaw law_of(const VectorXd& force, const VectorXd& deviation, const LocalMotion& motion, double correlated) {
  const Dictionary dictionary = dictionary_of(motion);
  const VectorXd weight = deviation.cwiseInverse() * deviation.mean();
  const MatrixXd columns = weight.asDiagonal() * dictionary.columns;
  const VectorXd target = weight.cwiseProduct(force);
  const double count = std::max(3.0, static_cast<double>(force.size()) / std::max(1.0, correlated));
  const double whole = target.squaredNorm(), floor = whole * exact * exact;
  std::vector<Index> chosen;
  double left = whole;
  while (chosen.size() < most_terms && left > floor) {
    Index best = -1;
    double least = left;
    for (Index k = 0; k < columns.cols(); ++k) {
      if (std::find(chosen.begin(), chosen.end(), k) != chosen.end()) continue;
      std::vector<Index> with = chosen;
      with.push_back(k);
      if (const double now = LeastSquares(columns, target, with).left; now < least) best = k, least = now;
    }
    if (best < 0 || count * std::log(left / std::max(least, floor)) - std::log(count) < convincing) break;
    chosen.push_back(best);
    left = least;
  }
  const auto alike = [&](std::size_t place) {
    std::vector<std::string> names;
    for (Index k = 0; k < columns.cols(); ++k) {
      if (std::find(chosen.begin(), chosen.end(), k) != chosen.end()) continue;
      std::vector<Index> other = chosen;
      other[place] = k;
      const double now = std::max(LeastSquares(columns, target, other).left, floor);
      if (count * std::log(now / std::max(left, floor)) < convincing)
        names.push_back(dictionary.names[static_cast<std::size_t>(k)]);
    }
    return names;
  };
  const LeastSquares fit(columns, target, chosen);
  ForceLaw law;
  law.explained = whole > 0 ? 1 - left / whole : 0;
  law.text = formula_of({});
  if (chosen.empty()) return law;
  const MatrixXd kept = columns(Eigen::all, chosen);
  const MatrixXd inverse = (kept.transpose() * kept).inverse();
  const double variance = left / std::max(1.0, count - static_cast<double>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto k = static_cast<Index>(i);
    const auto number = static_cast<std::size_t>(chosen[i]);
    law.terms.push_back({dictionary.names[number], fit.coefficients(k), std::sqrt(variance * inverse(k, k)), alike(i)});
    law.is_expression = law.is_expression && dictionary.is_expression[number];
  }
  law.text = formula_of(law.terms);
  return law;
}

}  // namespace tether
