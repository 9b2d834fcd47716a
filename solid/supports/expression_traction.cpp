#include "solid/supports/expression_traction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solid/expression.hpp"

namespace tether {
namespace {

/// Places of the names in the list of values.
constexpr int at_x = 0, at_n = 3, at_u = 6, at_v = 9, at_un = 12, at_vn = 13, at_t = 14, known_names = 15;

std::vector<std::string> all_names(const ExpressionLaw& law) {
  std::vector<std::string> names = expression_names();
  for (const Parameter& p : law.parameters) {
    if (std::find(names.begin(), names.end(), p.name) != names.end())
      throw input_error("parameter {}: the name stands for something else", p.name);
    names.push_back(p.name);
  }
  return names;
}

/// sigma n = f n + (g_x, g_y, g_z), each a formula; tangents by central differences, their symmetric part. (S.21)
class ExpressionTraction final : public Support {
 public:
  ExpressionTraction(const ExpressionLaw& law, std::span<const double> parameters)
      : step_(1e-6 * law.length), values_(known_names) {
    const std::vector<std::string> names = all_names(law);
    values_.insert(values_.end(), parameters.begin(), parameters.end());
    if (!law.normal.empty()) normal_.emplace_back(law.normal, names);
    for (const std::string& component : law.vector) vector_.emplace_back(component, names);
    moves_ = uses_any({"ux", "uy", "uz", "un"});
    damps_ = uses_any({"vx", "vy", "vz", "vn"});
  }

  SupportTraction at(const SupportPoint& p) const override {
    SupportTraction result{.traction = traction(p)};
    if (moves_) result.stiffness = by(p, &SupportPoint::displacement);
    if (damps_) result.damping = by(p, &SupportPoint::velocity);
    return result;
  }

 private:
  bool uses_any(std::initializer_list<const char*> names) const {
    const auto in = [&](const Expression& e) {
      return std::any_of(names.begin(), names.end(), [&](const char* name) { return e.uses(name); });
    };
    return std::any_of(normal_.begin(), normal_.end(), in) || std::any_of(vector_.begin(), vector_.end(), in);
  }

  Vec3 traction(const SupportPoint& p) const {
    const auto put = [&](int place, const Vec3& v) { std::copy(v.begin(), v.end(), values_.begin() + place); };
    put(at_x, p.position);
    put(at_n, p.normal);
    put(at_u, p.displacement);
    put(at_v, p.velocity);
    values_[at_un] = p.displacement.dot(p.normal);
    values_[at_vn] = p.velocity.dot(p.normal);
    values_[at_t] = p.time;
    Vec3 sum = Vec3::Zero();
    for (const Expression& f : normal_) sum += f(values_) * p.normal;
    for (std::size_t i = 0; i < vector_.size(); ++i) sum[static_cast<Eigen::Index>(i)] += vector_[i](values_);
    return sum;
  }

  Mat3 by(const SupportPoint& p, Vec3 SupportPoint::*member) const {
    Mat3 derivative;
    for (int i = 0; i < 3; ++i) {
      SupportPoint ahead = p, behind = p;
      ahead.*member += step_ * Vec3::Unit(i);
      behind.*member -= step_ * Vec3::Unit(i);
      derivative.col(i) = (traction(behind) - traction(ahead)) / (2 * step_);
    }
    return (derivative + derivative.transpose()) / 2;
  }

  double step_;
  std::vector<Expression> normal_, vector_;
  bool moves_, damps_;
  mutable std::vector<double> values_;
};

/// Places, motions and moments as a wall may have them, in no order.
std::vector<SupportPoint> probes(double length) {
  std::vector<SupportPoint> all;
  for (int k = 1; k <= 8; ++k) {
    const auto turn = [&](double phase) { return Vec3(std::cos(k + phase), std::sin(2 * k + phase), std::cos(3 * k)); };
    SupportPoint p{};
    p.position = length * turn(0);
    p.normal = turn(1).normalized();
    p.displacement = 0.05 * length * turn(2);
    p.velocity = length * turn(3);
    p.time = 0.1 * k;
    all.push_back(p);
  }
  return all;
}

/// A wall begins at rest, and some of its points stay there: 1/un would end every run.
void check_rest(const ExpressionLaw& law, const std::vector<double>& values) {
  const ExpressionTraction traction(law, values);
  const auto holds_at_rest = [&](SupportPoint p) {
    p.displacement = p.velocity = Vec3::Zero();
    try {
      traction.at(p);
    } catch (const RunError&) {
      return false;
    }
    return true;
  };
  const std::vector<SupportPoint> all = probes(law.length);
  if (std::none_of(all.begin(), all.end(), holds_at_rest))
    throw input_error("the formula has no finite value where the wall is at rest (displacement and velocity zero)");
}

/// A model without the effect is one in which the parameters that can be absent are.
void check_absent(const ExpressionLaw& law, std::vector<double> values) {
  std::string absent;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& p = law.parameters[i];
    if (std::isnan(p.absent)) continue;
    values[i] = p.absent;
    absent += fmt::format("{}{} = {:g}", absent.empty() ? "" : ", ", p.name, p.absent);
  }
  const ExpressionTraction traction(law, values);
  if (absent.empty()) return;
  for (const SupportPoint& p : probes(law.length)) {
    double size = 0;
    try {
      size = traction.at(p).traction.norm();
    } catch (const RunError&) {
      continue;  // a formula need not hold everywhere
    }
    if (size > 0)
      throw input_error("the formula is not zero at {}, where it is said to be absent: it would be switched off there",
                        absent);
  }
}

}  // namespace

const std::vector<std::string>& expression_names() {
  static const std::vector<std::string> names{"x",  "y",  "z",  "nx", "ny", "nz", "ux", "uy",
                                              "uz", "vx", "vy", "vz", "un", "vn", "t"};
  return names;
}

Configured<Support> configure(const ExpressionLaw& law, std::vector<double> values) {
  check_rest(law, values);
  check_absent(law, values);
  auto declaration = std::make_shared<EffectDeclaration>(EffectDeclaration{
      "expression", "A traction as the case file writes it", Place::outer_wall, law.parameters, EffectRole::loads});
  return {std::move(declaration),
          [law](std::span<const double> v) -> std::unique_ptr<Support> {
            return std::make_unique<ExpressionTraction>(law, v);
          },
          std::move(values)};
}

}  // namespace tether
