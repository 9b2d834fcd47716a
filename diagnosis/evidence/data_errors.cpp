#include "diagnosis/evidence/data_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace tether {
namespace {

using Index = Eigen::Index;

/// The base run a moment earlier or later.
FinishedMotion shifted(const FinishedMotion& base, double by) {
  FinishedMotion run = base;
  run.motion.positions = [&base, by](double time) {
    return base.motion.positions(std::clamp(time + by, base.motion.start, base.motion.end));
  };
  return run;
}

/// How fast the model's lumen moves outward at each datum: frames shown later than they say lie that much farther out.
VectorXd outward_velocity(const Evidence& evidence, const FinishedMotion& base, double h) {
  const FinishedMotion before = shifted(base, -h), after = shifted(base, h);
  const MatrixXd residuals = evidence.residuals({&before, &after});
  VectorXd velocity = (residuals.col(0) - residuals.col(1)) / (2 * h);
  for (const auto& part : evidence.parts())
    if (!evidence.fallible(part).in_time) velocity.segment(part.first, part.count).setZero();
  return velocity.array().isFinite().select(velocity, 0);
}

/// Adds candidates with columns that are zero outside some parts.
class DataErrors {
 public:
  DataErrors(EffectProblem& problem, const Evidence& evidence) : problem_(problem), evidence_(evidence) {}

  /// As an error that is allowed and, if it `competes`, as a candidate.
  void add(const Candidate& candidate, const std::vector<Amplitude>& amplitudes, const MatrixXd& columns,
           double allowed, bool competes = true) {
    if (!competes) {
      for (const auto& column : columns.colwise()) allow(problem_, column, allowed, "");
      return;
    }
    Candidate added = candidate;
    for (Index k = 0; k < columns.cols(); ++k) {
      added.amplitudes.push_back(problem_.changes.cols() + k);
      problem_.amplitudes.push_back(amplitudes[static_cast<std::size_t>(k)]);
      allow(problem_, columns.col(k), allowed, candidate.name + " at " + candidate.where);
    }
    append_columns(problem_.changes, columns);
    problem_.candidates.push_back(added);
  }
  /// Values of a whole source, or of one frame.
  MatrixXd only(const MatrixXd& values, std::size_t source, const Evidence::Part* frame) const {
    MatrixXd columns = MatrixXd::Zero(values.rows(), values.cols());
    for (const auto& part : evidence_.parts())
      if (part.source == source && (frame == nullptr || &part == frame))
        columns.middleRows(part.first, part.count) = values.middleRows(part.first, part.count);
    return columns;
  }

 private:
  EffectProblem& problem_;
  const Evidence& evidence_;
};

std::vector<Amplitude> in_space(const std::string& unit) {
  std::vector<Amplitude> all;
  for (const char* axis : {"x", "y", "z"})
    all.push_back({axis, std::string("displacement of the data in ") + axis, unit});
  return all;
}

/// How far the data lie farther out if a source is turned about its middle, one column for each axis [n x 3]; and which
/// of them the data show: a round tube does not, about its own axis.
struct Turned {
  MatrixXd columns;
  Vec3 middle{0, 0, 0};
  std::vector<Index> seen;
};

Turned turned_about_middle(const Evidence& evidence, std::size_t source) {
  constexpr double hardly_seen = 0.03;  // of the best seen axis's squares
  Turned turned;
  turned.columns = MatrixXd::Zero(evidence.places().cols(), 3);
  double count = 0;
  for (const auto& part : evidence.parts())
    if (part.source == source) {
      turned.middle += evidence.places().middleCols(part.first, part.count).rowwise().sum();
      count += static_cast<double>(part.count);
    }
  turned.middle /= count;
  for (const auto& part : evidence.parts())
    for (Index i = part.first; part.source == source && i < part.first + part.count; ++i)
      turned.columns.row(i) =
          (evidence.places().col(i) - turned.middle).cross(Vec3(evidence.normals().col(i))).transpose();
  const Vec3 squares = turned.columns.colwise().squaredNorm();
  for (Index axis = 0; axis < 3; ++axis)
    if (squares(axis) > hardly_seen * squares.maxCoeff()) turned.seen.push_back(axis);
  return turned;
}

/// Whether some frame of a source is the imaged lumen: then the data as a whole are neither displaced nor turned nor
/// too large, since the model was made of them.
bool shows_the_image(const Evidence& evidence, std::size_t source, const Points& imaged) {
  constexpr double same = 0.5;  // of the noise: with it, two segmentations lie farther apart
  return std::any_of(evidence.parts().begin(), evidence.parts().end(), [&](const Evidence::Part& part) {
    return part.source == source && evidence.fallible(part).in_place &&
           evidence.distance_from(imaged, part) < same * evidence.noise(part).deviation;
  });
}

std::vector<Amplitude> in_angle(const std::vector<Index>& axes) {
  constexpr double far = 0.35;  // 20 degrees: beyond, first order says nothing
  std::vector<Amplitude> all;
  for (const Index axis : axes) {
    const std::string name(1, "xyz"[axis]);
    all.push_back(
        {"about_" + name, "rotation of the data about " + name, "rad", false, undefined, 0, false, -far, far});
  }
  return all;
}

}  // namespace

std::string frame_text(const Evidence& evidence, const Evidence::Part& part) {
  return fmt::format("{}, {:.4g} s", evidence.name_of(part), part.frame.time);
}

void append_columns(MatrixXd& to, const MatrixXd& columns) {
  to.conservativeResize(columns.rows(), to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

void allow(EffectProblem& problem, const VectorXd& column, double deviation, const std::string& name) {
  if (!(deviation > 0)) return;
  problem.allowed_names.push_back(name);
  append_columns(problem.allowed, column);
  problem.allowed_deviation.conservativeResize(problem.allowed.cols());
  problem.allowed_deviation(problem.allowed.cols() - 1) = deviation;
}

void add_data_errors(EffectProblem& problem, const Evidence& evidence, const FinishedMotion& base,
                     const AllowanceCase& allowed, const std::string& unit_of_length, const std::string& unit_of_time) {
  DataErrors errors(problem, evidence);
  const MatrixXd ones = MatrixXd::Ones(problem.residual.size(), 1), normals = evidence.normals().transpose(),
                 blurred = -0.5 * Eigen::Map<const VectorXd>(evidence.curvatures().data(), ones.rows()),  // (D.17)
      velocity = outward_velocity(evidence, base, 1e-3 * (base.motion.end - base.motion.start));
  std::map<std::size_t, int> frames;
  for (const auto& part : evidence.parts()) frames[part.source] += 1;
  std::size_t last = evidence.parts().size();
  Turned turned;
  for (const auto& part : evidence.parts()) {
    if (!evidence.fallible(part).in_place) continue;
    const std::string name = evidence.name_of(part);
    const double sigma = evidence.noise(part).deviation;
    const Amplitude shift{"time_shift", "the frames show the vessel that much later than they say", unit_of_time};
    if (part.source != last) turned = turned_about_middle(evidence, part.source);
    Candidate error{"misregistration", name, "The data are displaced as a whole", Candidate::Kind::data, {}};
    error.data = {evidence.field_of(part), undefined, turned.middle};
    const auto named = [&](const char* type, const char* meaning) {
      Candidate other = error;
      other.name = type, other.meaning = meaning;
      return other;
    };
    if (part.source != last) {
      last = part.source;
      const bool competes = !shows_the_image(evidence, part.source, base.motion.imaged);
      errors.add(error, in_space(unit_of_length), errors.only(normals, part.source, nullptr),
                 allowed.displacement.value_or(0.5 * sigma), competes);
      errors.add(named("misrotation", "The data are turned as a whole, about their middle"), in_angle(turned.seen),
                 turned.columns(Eigen::all, turned.seen), 0, competes);
      errors.add(named("segmentation_bias", "The measured lumen is too large or too small all over"),
                 {{"bias", "along the outward normal", unit_of_length}}, errors.only(ones, part.source, nullptr),
                 allowed.bias.value_or(0.5 * sigma), competes);
      errors.add(named("blur", "The image is blurred, which draws a curved surface inward"),
                 {{"variance", "of the image's blur", unit_of_length + "2", true, undefined, 0, false, 0}},
                 errors.only(blurred, part.source, nullptr), 0, competes);
      errors.add(named("gating_shift", "The times of all frames are off"), {shift},
                 errors.only(velocity, part.source, nullptr), allowed.time_shift.value_or(0));
    }
    if (part.frame.held_out || frames[part.source] < 2) continue;
    error.where = frame_text(evidence, part);
    error.confirmable = false;
    error.data.frame = part.frame.label;
    errors.add(named("misplaced_frame", "One frame is displaced"), in_space(unit_of_length),
               errors.only(normals, part.source, &part), allowed.frame_displacement);
    errors.add(named("mistimed_frame", "One frame shows another moment than it says"), {shift},
               errors.only(velocity, part.source, &part), 0);
  }
}

void add_patterns(EffectProblem& problem, const Evidence& evidence, const AllowanceCase& allowed, double start,
                  double end) {
  const auto n = problem.residual.size();
  struct Column {
    VectorXd values;
    double deviation;
  };
  std::map<std::tuple<int, double, int>, Column> columns;  // a NaN has no order: start - 1, - 2, - 3 stand for the beat
  for (const auto& part : evidence.parts()) {
    if (!evidence.fallible(part).in_place) continue;
    const double phase = 2 * std::numbers::pi * (part.time - start) / (end - start);
    const double model = allowed.model.value_or(0.25 * evidence.noise(part).deviation);
    const auto add = [&](double key, double value, int form) {
      for (Index i = part.first; i < part.first + part.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double shape = std::cos(form * std::numbers::pi * evidence.along()[k]);
        columns.try_emplace({evidence.regions()[k], key, form}, Column{VectorXd::Zero(n), model})
            .first->second.values(i) = value * shape;
      }
    };
    for (int form = 0; form < 3; ++form) add(part.time, 1, form);
    add(start - 1, 1, 0);
    add(start - 2, std::cos(phase), 0);
    add(start - 3, std::sin(phase), 0);
  }
  for (const auto& [place, column] : columns) {
    const auto& [number, time, form] = place;
    append_columns(problem.patterns, column.values);
    const std::string region = number >= 0 ? evidence.region_names()[static_cast<std::size_t>(number)] : "wall";
    problem.pattern_names.push_back({region, time < start - 0.5 ? undefined : time, static_cast<Pattern::Form>(form)});
    allow(problem, column.values, column.deviation, "");
  }
}

}  // namespace tether
