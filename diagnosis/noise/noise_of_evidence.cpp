#include "diagnosis/noise/noise_of_evidence.hpp"

#include <algorithm>
#include <map>

#include "common/base/error.hpp"
#include "diagnosis/noise/measured_noise.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// A remark is worth a few seconds, and no more.
constexpr Index most_points = 300;

MatrixXd free_columns(const EffectProblem& problem, const MatrixXd& further) {
  std::vector<Index> own;
  for (Index k = 0; k < problem.allowed.cols(); ++k) {
    const auto& patterns = problem.allowed_patterns;
    if (std::find(patterns.begin(), patterns.end(), k) == patterns.end() && problem.allowed.col(k).allFinite())
      own.push_back(k);
  }
  MatrixXd all(problem.residual.size(), static_cast<Index>(own.size()) + further.cols());
  all << problem.allowed(Eigen::all, own), further;
  return all;
}

/// Frames whose data are alike in number and order: of one series of a source.
using Frames = std::vector<const Evidence::Part*>;

/// Numbers within a frame of the data that all these frames have.
std::vector<Index> common_data(const Frames& frames, const EffectProblem& problem, const VectorXd& residual) {
  std::vector<Index> all;
  for (Index i = 0; i < frames.front()->count; ++i)
    if (std::all_of(frames.begin(), frames.end(), [&](const Evidence::Part* part) {
          return i < part->count && problem.precision(part->first + i) > 0 && std::isfinite(residual(part->first + i));
        }))
      all.push_back(i);
  return all;
}

/// Data less what is free in each frame.
Index data_to_spare(const std::vector<NoiseField>& fields) {
  Index count = 0;
  for (const NoiseField& field : fields)
    count += (field.places.cols() - field.free.cols()) * static_cast<Index>(field.frames.size());
  return count;
}

NoiseField field_of(const Evidence& evidence, const Frames& frames, std::vector<Index> rows, const VectorXd& residual,
                    const MatrixXd& free) {
  const auto n = static_cast<Index>(rows.size());
  Points places = Points::Zero(3, n), normals = places;
  NoiseField field;
  for (const Evidence::Part* part : frames) {
    std::vector<Index> own = rows;
    for (Index& row : own) row += part->first;
    places += evidence.places()(Eigen::all, own) / static_cast<double>(frames.size());
    normals += evidence.normals()(Eigen::all, own);
    field.frames.push_back({residual(own), free(own, Eigen::all), part->time});
  }
  for (NoiseFrame& frame : field.frames) frame.shared = averaged(places, frame.shared);
  normals.colwise().normalize();
  field.places = places;
  field.free = offset_and_shift(places, normals);
  return field;
}

}  // namespace

std::vector<NoiseCheck> noise_checks(const Evidence& evidence, const EffectProblem& problem, const VectorXd& residual,
                                     const MatrixXd& further) {
  const MatrixXd free = free_columns(problem, further);
  std::map<std::size_t, std::map<int, Frames>> sources;
  for (const Evidence::Part& part : evidence.parts())
    if (evidence.source(part).facts().kind.pulls_wall && evidence.noise(part).correlation_length > 0)
      sources[part.source][part.frame.series].push_back(&part);
  std::vector<NoiseCheck> all;
  for (const auto& [source, series] : sources) {
    std::vector<NoiseField> fields;
    for (const auto& [number, frames] : series)
      if (auto rows = common_data(frames, problem, residual); rows.size() > 20)
        fields.push_back(field_of(evidence, frames, std::move(rows), residual, free));
    if (data_to_spare(fields) < 2 * free.cols() + 20) continue;
    NoiseCheck check = *measured_noise(fields, evidence.noise_of(source), most_points).stated;
    check.source = evidence.field_of(*series.begin()->second.front());
    all.push_back(std::move(check));
  }
  return all;
}

}  // namespace tether
