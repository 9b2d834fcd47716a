#include "tether/conform/excitation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tether::protocol {

namespace {

using Vector = std::array<double, 3>;

Vector node(const Numbers& values, std::int64_t index) {
  const auto first = values.begin() + 3 * static_cast<std::ptrdiff_t>(index);
  return {first[0], first[1], first[2]};
}

Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double inner(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Numbers combined(double a, const Numbers& x, double b, const Numbers& y) {
  TETHER_ASSERT(x.size() == y.size(), "{} {}", x.size(), y.size());
  Numbers sum(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sum[i] = a * x[i] + b * y[i];
  return sum;
}

double dot(const Numbers& x, const Numbers& y) {
  TETHER_ASSERT(x.size() == y.size(), "{} {}", x.size(), y.size());
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

double largest(const Numbers& x) {
  double result = 0;
  for (const double value : x) result = std::max(result, std::abs(value));
  return result;
}

double difference(const Numbers& x, const Numbers& y) {
  if (x.size() != y.size()) return infinite;
  const double scale = std::max(largest(x), largest(y));
  return scale == 0 ? 0 : largest(combined(1, x, -1, y)) / scale;
}

Shape::Shape(const Interface& surface) : area_vectors(surface.points.size()) {
  Vector low{infinite, infinite, infinite}, high{-infinite, -infinite, -infinite}, mean{};
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], surface.points[i]);
    high[i % 3] = std::max(high[i % 3], surface.points[i]);
    mean[i % 3] += 3 * surface.points[i] / static_cast<double>(surface.points.size());
  }
  size = std::sqrt(inner(high - low, high - low));
  double area = 0;
  for (std::size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t i) { return node(surface.points, surface.triangles[t + i]); };
    const Vector normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t i = 0; i < 3; ++i) {
      outwardness += inner(corner(i) - mean, normal) / 6;
      for (std::size_t d = 0; d < 3; ++d)
        area_vectors[3 * static_cast<std::size_t>(surface.triangles[t + i]) + d] += normal[d] / 6;
    }
    area += std::sqrt(inner(normal, normal)) / 2;
  }
  outwardness /= size * area;
}

Numbers beneath(const Interface& surface) {
  Numbers places;
  for (std::size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t i) { return node(surface.points, surface.triangles[t + i]); };
    const Vector a = corner(0), b = corner(1), c = corner(2), normal = cross(b - a, c - a);
    const double depth = 0.05 / std::pow(inner(normal, normal), 0.25);  // over the normal's length, twice the area
    for (std::size_t d = 0; d < 3; ++d) places.push_back((a[d] + b[d] + c[d]) / 3 - depth * normal[d]);
  }
  return places;
}

Excitation::Excitation(Partner& partner, const Interface& surface, double dt)
    : partner_(partner), dt_(dt), displacement_(surface.points.size()), last_motion_(displacement_) {
  const Shape shape(surface);
  target_ = 1e-4 * shape.size;
  const double scale = is_fluid() ? target_ / dt / largest(shape.area_vectors) : 1;
  first_ = second_ = shape.area_vectors;
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double z = surface.points[i - i % 3 + 2] / shape.size, x = surface.points[i - i % 3] / shape.size;
    first_[i] *= scale * (1 + 0.3 * std::cos(5 * z));
    second_[i] *= scale * (0.2 + std::sin(3 * x + 2 * z));
  }
}

Numbers Excitation::excitation(double amplitude, double change) const {
  return combined(amplitude, first_, change, second_);
}

void Excitation::begin() {
  partner_.ask(BeginStep{step_, dt_ * static_cast<double>(step_), dt_, displacement_});
  last_motion_ = displacement_;
}

Numbers Excitation::evaluate(double amplitude, double change) {
  const Numbers input = excitation(amplitude, change);
  if (is_fluid()) {
    last_motion_ = combined(1, displacement_, dt_, input);
    return partner_.ask(FluidEvaluate{last_motion_, input}).forces;
  }
  Motion motion = partner_.ask(SolidEvaluate{input});
  last_motion_ = motion.displacement;
  motion.displacement.insert(motion.displacement.end(), motion.velocity.begin(), motion.velocity.end());
  return motion.displacement;
}

Numbers Excitation::tangent() {
  if (is_fluid()) return partner_.ask(FluidTangent{second_}).forces;
  Motion change = partner_.ask(SolidTangent{second_});
  change.displacement.insert(change.displacement.end(), change.velocity.begin(), change.velocity.end());
  return change.displacement;
}

StepReport Excitation::end(bool accepted) {
  const StepReport report = partner_.ask(EndStep{accepted});
  if (accepted) {
    displacement_ = last_motion_;
    ++step_;
  }
  return report;
}

double Excitation::motion() {
  begin();
  const Numbers start = displacement_;
  try {
    evaluate(1);
  } catch (const PartnerFailed&) {
    end(false);
    return undefined;
  }
  end(false);
  return largest(combined(1, last_motion_, -1, start));
}

void Excitation::calibrate() {
  if (is_fluid()) return;
  const auto scale_by = [this](double factor) {
    first_ = combined(factor, first_, 0, first_);
    second_ = combined(factor, second_, 0, second_);
  };
  double moved = motion();
  for (const double factor : {1e3, 1e3, 1e-9}) {  // which load is a reasonable one depends on the units
    if (moved > 0) break;
    scale_by(factor);
    moved = motion();
  }
  for (int i = 0; i < 3 && moved > 0; ++i) {
    scale_by(target_ / moved);
    moved = motion();
  }
  if (!(moved > 0)) throw run_error("no load was found under which the solid takes a step and moves");
}

}  // namespace tether::protocol
