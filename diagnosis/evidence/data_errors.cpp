#include "diagnosis/evidence/data_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "observation_manager/measurements/faults/faults.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// The base run a moment earlier or later.
FinishedMotion shifted(const FinishedMotion& base, double by) {
  FinishedMotion run = base;
  run.motion.positions = [&base, by](double time) {
    return base.motion.positions(std::clamp(time + by, base.motion.start, base.motion.end));
  };
  run.trace = [&base, by](const std::string& column) {
    RunTrace trace = base.trace(column);
    for (double& time : trace.times) time -= by;
    return trace;
  };
  return run;
}

/// How fast the model's lumen moves outward at each datum, or its value grows: frames shown later than they say lie
/// that much farther out.
VectorXd rate_of(const Evidence& evidence, const FinishedMotion& base, double h) {
  const FinishedMotion before = shifted(base, -h), after = shifted(base, h);
  const MatrixXd residuals = evidence.residuals({&before, &after});
  VectorXd rate = (residuals.col(0) - residuals.col(1)) / (2 * h);
  for (const auto& part : evidence.parts())
    if (const Fallible& data = evidence.fallible(part); !data.in_time && !data.in_value)
      rate.segment(part.first, part.count).setZero();
  return rate.array().isFinite().select(rate, 0);
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

Amplitude amplitude_of(const FaultNumber& number, const UnitSystem& units) {
  Amplitude amplitude{number.name, number.meaning, number.unit.empty() ? units.symbol(number.dimension) : number.unit};
  amplitude.one_sided = number.lower == 0;
  amplitude.lower = number.lower;
  amplitude.upper = number.upper;
  amplitude.scale = number.scale;
  return amplitude;
}

bool is_looked_for(const FaultDeclaration& fault, const std::vector<std::string>& asked) {
  return !fault.on_request || std::find(asked.begin(), asked.end(), fault.of_all.name) != asked.end();
}

/// Everything that data of one source may err in.
class SourceErrors {
 public:
  SourceErrors(EffectProblem& problem, const Evidence& evidence, const VectorXd& rate, const AllowanceCase& allowed,
               const UnitSystem& units, const std::vector<std::string>& asked,
               const std::vector<const Evidence::Part*>& parts)
      : problem_(problem), evidence_(evidence), allowed_(allowed), units_(units), parts_(parts) {
    const SourceData data = data_of(rate);
    middle_ = data.middle;
    for (const auto& fault : faults_) {
      const FaultDeclaration& said = fault->declaration();
      if (is_looked_for(said, asked)) possible_.push_back({*fault, fault->columns(data)});
    }
  }

  /// shows_image: whether a frame is the imaged lumen. What that rules out is no candidate.
  void add_of_all(bool shows_image) {
    for (const Possible& error : possible_) {
      const double allowed = error.fault.allowed(allowed_, evidence_.noise(*parts_.front()).deviation);
      if (shows_image && error.fault.declaration().ruled_out_by_image)
        allow_all(only(error.columns.values, nullptr), allowed);
      else
        add(candidate(error.fault.declaration().of_all), error, nullptr, allowed);
    }
  }
  void add_of_frame(const Evidence::Part& frame) {
    for (const Possible& error : possible_) {
      Candidate added = candidate(error.fault.declaration().of_frame);
      added.where = frame_text(evidence_, frame);
      added.confirmable = false;
      added.data.frame = frame.frame.label;
      add(added, error, &frame, error.fault.allowed_of_frame(allowed_));
    }
  }

 private:
  struct Possible {
    const Fault& fault;
    FaultColumns columns;
  };

  Candidate candidate(const FaultName& name) const {
    const Evidence::Part& part = *parts_.front();
    Candidate error{name.name, evidence_.name_of(part), name.meaning, Candidate::Kind::data, {}};
    error.data = {evidence_.field_of(part), undefined, middle_};
    return error;
  }
  void allow_all(const MatrixXd& columns, double deviation) {
    for (const auto& column : columns.colwise()) allow(problem_, column, deviation);
  }
  /// As an error that is allowed and as a candidate, unless it is not looked for.
  void add(Candidate added, const Possible& error, const Evidence::Part* frame, double allowed) {
    if (added.name.empty()) return;
    const MatrixXd columns = only(error.columns.values, frame);
    for (Index k = 0; k < columns.cols(); ++k) {
      added.amplitudes.push_back(problem_.changes.cols() + k);
      problem_.amplitudes.push_back(amplitude_of(error.columns.numbers[static_cast<std::size_t>(k)], units_));
      allow(problem_, columns.col(k), allowed, {added.name + " at " + added.where, problem_.amplitudes.back()});
    }
    append_columns(problem_.changes, columns);
    problem_.candidates.push_back(added);
  }

  SourceData data_of(const VectorXd& rate) const {
    SourceData data;
    std::vector<Index> rows;
    for (const Evidence::Part* part : parts_) {
      data.middle += evidence_.places().middleCols(part->first, part->count).rowwise().sum();
      for (Index i = part->first; i < part->first + part->count; ++i) rows.push_back(i);
    }
    data.middle /= static_cast<double>(rows.size());
    const auto of_all = [](const std::vector<double>& values) {
      return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
    };
    data.places = evidence_.places()(Eigen::all, rows);
    data.normals = evidence_.normals()(Eigen::all, rows);
    data.curvatures = of_all(evidence_.curvatures())(rows);
    data.rate = rate(rows);
    data.times = of_all(evidence_.times())(rows);
    data.values = of_all(evidence_.shown())(rows);
    data.dimension = evidence_.source(*parts_.front()).facts().dimension;
    return data;
  }
  /// Of all data: zero outside the source, or one frame of it.
  MatrixXd only(const MatrixXd& values, const Evidence::Part* frame) const {
    MatrixXd columns = MatrixXd::Zero(problem_.residual.size(), values.cols());
    Index row = 0;
    for (const Evidence::Part* part : parts_) {
      if (frame == nullptr || part == frame)
        columns.middleRows(part->first, part->count) = values.middleRows(row, part->count);
      row += part->count;
    }
    return columns;
  }

  EffectProblem& problem_;
  const Evidence& evidence_;
  const AllowanceCase& allowed_;
  const UnitSystem& units_;
  std::vector<const Evidence::Part*> parts_;
  Faults faults_{evidence_.fallible(*parts_.front())};
  Vec3 middle_{0, 0, 0};
  std::vector<Possible> possible_;
};

/// The parts of each source, in their order.
std::vector<std::vector<const Evidence::Part*>> by_source(const Evidence& evidence) {
  std::vector<std::vector<const Evidence::Part*>> sources;
  for (const auto& part : evidence.parts()) {
    if (sources.empty() || sources.back().front()->source != part.source) sources.emplace_back();
    sources.back().push_back(&part);
  }
  return sources;
}

}  // namespace

std::vector<std::string> faults_not_asked(const Evidence& evidence, const std::vector<std::string>& asked) {
  std::vector<std::string> names;
  for (const auto& parts : by_source(evidence))
    for (const auto& fault : Faults(evidence.fallible(*parts.front()))) {
      const FaultDeclaration& said = fault->declaration();
      if (is_looked_for(said, asked) || std::count(names.begin(), names.end(), said.of_all.name) > 0) continue;
      names.push_back(said.of_all.name);
    }
  return names;
}

std::string frame_text(const Evidence& evidence, const Evidence::Part& part) {
  return fmt::format("{}, {:.4g} s", evidence.name_of(part), part.frame.time);
}

void append_columns(MatrixXd& to, const MatrixXd& columns) {
  to.conservativeResize(columns.rows(), to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

void allow(EffectProblem& problem, const VectorXd& column, double deviation, const AllowedError& error) {
  if (!(deviation > 0)) return;
  problem.allowed_errors.push_back(error);
  append_columns(problem.allowed, column);
  problem.allowed_deviation.conservativeResize(problem.allowed.cols());
  problem.allowed_deviation(problem.allowed.cols() - 1) = deviation;
}

void add_data_errors(EffectProblem& problem, const Evidence& evidence, const FinishedMotion& base,
                     const AllowanceCase& allowed, const UnitSystem& units, const std::vector<std::string>& asked) {
  const VectorXd rate = rate_of(evidence, base, 1e-3 * (base.motion.end - base.motion.start));
  for (const auto& parts : by_source(evidence)) {
    SourceErrors errors(problem, evidence, rate, allowed, units, asked, parts);
    errors.add_of_all(shows_the_image(evidence, parts.front()->source, base.motion.imaged));
    if (parts.size() < 2) continue;
    for (const Evidence::Part* part : parts)
      if (!part->frame.held_out) errors.add_of_frame(*part);
  }
}

}  // namespace tether
