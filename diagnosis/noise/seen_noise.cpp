#include "diagnosis/noise/seen_noise.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "diagnosis/noise/seen_frames.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "observation_manager/measurements/surface_check.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

std::string name_of(const LumenSeries& data, const Frame& frame) {
  const std::string number = fmt::format("{:g}", frame.label);
  const auto names = data.series_names();
  return names.size() > 1 ? names[static_cast<std::size_t>(frame.series)] + " " + number : number;
}

/// How far along the direction in which the places extend most, as one column.
MatrixXd slope(const Points& places) {
  const Points apart = places.colwise() - places.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(apart * apart.transpose());
  return apart.transpose() * axes.eigenvectors().col(2);
}

MatrixXd beside(const MatrixXd& left, const MatrixXd& right) {
  MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

double root_mean_square(const VectorXd& values) {
  return values.size() > 0 ? std::sqrt(values.squaredNorm() / static_cast<double>(values.size())) : 0;
}

/// What is left of values once the columns are fitted.
VectorXd freed(const VectorXd& values, const MatrixXd& columns) {
  return values - columns * columns.completeOrthogonalDecomposition().solve(values);
}

/// Two frames of one series, one after the other.
struct Pair {
  std::size_t first;
  double motion;  ///< of the model between them, root mean square along the normals [length]
};

/// Each frame in one pair at most, those of least motion first.
std::vector<Pair> apart_from_each_other(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.motion < b.motion; });
  std::vector<Pair> chosen;
  for (const Pair& pair : pairs)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const Pair& other) {
          return std::max(pair.first, other.first) - std::min(pair.first, other.first) < 2;
        }))
      chosen.push_back(pair);
  return chosen;
}

/// The pairs of a series that are at rest, as a field; nothing if there are none.
class RestingPairs {
 public:
  RestingPairs(const LumenSeries& data, const RunMotion& run, SeenNoise& seen) : data_(data), run_(run), seen_(seen) {}

  void add(std::vector<SeenFrame> frames) {
    const std::vector<std::size_t> samples = common_samples(frames);
    if (samples.empty()) return;
    const MeanPlaces mean = mean_places(frames, samples);
    NoiseField field{mean.places, offset_and_shift(mean.places, mean.normals), {}};
    std::vector<Pair> resting;
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
      const double moved = root_mean_square(motion(frames, i, samples));
      const double noise = seen_.stated.deviation > 0
                               ? seen_.stated.deviation
                               : root_mean_square(freed(difference(frames, i, samples), field.free)) / std::sqrt(2);
      if (moved < noise) resting.push_back({i, moved});
    }
    resting = apart_from_each_other(std::move(resting));
    for (std::size_t k = 0; k < resting.size(); ++k) {
      const std::size_t i = resting[k].first;
      MatrixXd own = MatrixXd::Zero(mean.places.cols(), static_cast<Index>(resting.size()));
      own.col(static_cast<Index>(k)) = averaged(mean.places, motion(frames, i, samples));
      field.frames.push_back({difference(frames, i, samples) / std::sqrt(2), own, frames[i].time});
      seen_.apart.push_back(frames[i + 1].time - frames[i].time);
      seen_.frames.push_back(
          fmt::format("{} and {}", name_of(data_, frames[i].frame), name_of(data_, frames[i + 1].frame)));
    }
    if (!field.frames.empty()) seen_.fields.push_back(std::move(field));
  }

 private:
  VectorXd motion(const std::vector<SeenFrame>& frames, std::size_t i, const std::vector<std::size_t>& samples) const {
    return along_normals(run_.positions(frames[i + 1].time) - run_.positions(frames[i].time), frames[i], samples);
  }
  /// Both against the imaged lumen.
  static VectorXd difference(const std::vector<SeenFrame>& frames, std::size_t i,
                             const std::vector<std::size_t>& samples) {
    return distances(frames[i + 1], samples) - distances(frames[i], samples);
  }

  const LumenSeries& data_;
  const RunMotion& run_;
  SeenNoise& seen_;
};

/// Shared columns begin where those of the fields before end.
void make_shared_apart(std::vector<NoiseField>& fields) {
  Index all = 0, first = 0;
  for (const NoiseField& field : fields) all += field.frames.front().shared.cols();
  for (NoiseField& field : fields) {
    const Index own = field.frames.front().shared.cols();
    for (NoiseFrame& frame : field.frames) {
      MatrixXd columns = MatrixXd::Zero(frame.shared.rows(), all);
      columns.middleCols(first, own) = frame.shared;
      frame.shared = columns;
    }
    first += own;
  }
}

std::optional<NoiseField> residual_field(std::vector<SeenFrame> frames, const RunMotion& run) {
  const std::vector<std::size_t> samples = common_samples(frames);
  if (samples.empty()) return std::nullopt;
  const MeanPlaces mean = mean_places(frames, samples);
  NoiseField field{mean.places, beside(offset_and_shift(mean.places, mean.normals), slope(mean.places)), {}};
  const double step = 1e-3 * (run.end - run.start);
  for (const SeenFrame& frame : frames) {
    const double before = std::max(run.start, frame.time - step), after = std::min(run.end, frame.time + step);
    MatrixXd shared(mean.places.cols(), 2);
    shared.col(0) = along_normals(run.positions(frame.time) - run.imaged, frame, samples);
    shared.col(1) = along_normals(run.positions(after) - run.positions(before), frame, samples) / (after - before);
    field.frames.push_back({distances(frame, samples), averaged(mean.places, shared), frame.time});
  }
  return field;
}

/// Frames of the same number of samples and the same time, of two series.
std::optional<NoiseField> differences(const SeenSeries& one, const SeenSeries& other, double same, SeenNoise& seen,
                                      const LumenSeries& data) {
  std::vector<SeenFrame> first, second;
  for (const SeenFrame& a : one.frames)
    for (const SeenFrame& b : other.frames)
      if (std::abs(a.time - b.time) <= same && a.samples.size() == b.samples.size())
        first.push_back(a), second.push_back(b);
  std::vector<SeenFrame> both = first;
  both.insert(both.end(), second.begin(), second.end());
  const std::size_t found = both.size();
  const std::vector<std::size_t> samples = common_samples(both);
  if (samples.empty() || both.size() < found) return std::nullopt;
  const MeanPlaces mean = mean_places(both, samples);
  NoiseField field{mean.places, offset_and_shift(mean.places, mean.normals), {}};
  for (std::size_t k = 0; k < first.size(); ++k) {
    field.frames.push_back({(distances(first[k], samples) - distances(second[k], samples)) / std::sqrt(2),
                            MatrixXd(mean.places.cols(), 0), first[k].time});
    seen.frames.push_back(name_of(data, first[k].frame));
  }
  return field;
}

}  // namespace

namespace {

/// The series of the other source that shows the same: its only one of surfaces, the slice of that name of contours.
const SeenSeries* same_in(const std::vector<SeenSeries>& others, const LumenSeries& other, const SeenSeries& series,
                          const LumenSeries& one) {
  const auto name = [](const LumenSeries& data, const SeenSeries& seen) {
    return data.series_names()[static_cast<std::size_t>(seen.series)];
  };
  const bool has_slices = one.sample_dimension() == 1;
  const auto found = std::find_if(others.begin(), others.end(), [&](const SeenSeries& s) {
    return has_slices ? name(other, s) == name(one, series) : s.series == series.series;
  });
  return found == others.end() ? nullptr : &*found;
}

}  // namespace

std::vector<SeenNoise> repeated_noise(const Observations& data, const RunMotion& run) {
  std::vector<SeenNoise> all;
  const LumenAt imaged = [&](double) { return run.imaged; };
  for (std::size_t i = 0; i < data.lumen.size(); ++i)
    for (std::size_t j = i + 1; j < data.lumen.size(); ++j) {
      const LumenSeries &one = *data.lumen[i], &other = *data.lumen[j];
      if (&one.kind() != &other.kind()) continue;
      SeenNoise seen{
          NoiseOrigin::repeated, one.facts().field() + " and " + other.settings().name, {}, one.facts().noise, {}};
      const auto first = seen_series(one, run, imaged), second = seen_series(other, run, imaged);
      for (const SeenSeries& series : first)
        if (const SeenSeries* same = same_in(second, other, series, one))
          if (auto field = differences(series, *same, 1e-6 * (run.end - run.start), seen, one))
            seen.fields.push_back(std::move(*field));
      if (!seen.fields.empty()) all.push_back(std::move(seen));
    }
  return all;
}

std::vector<SeenNoise> noise_at_rest(const Observations& data, const RunMotion& run) {
  std::vector<SeenNoise> all;
  for (const auto& source : data.lumen) {
    SeenNoise seen{NoiseOrigin::rest, source->facts().field(), {}, source->facts().noise, {}};
    RestingPairs pairs(*source, run, seen);
    for (SeenSeries& series : seen_series(*source, run, [&](double) { return run.imaged; }))
      pairs.add(std::move(series.frames));
    make_shared_apart(seen.fields);
    if (!seen.fields.empty()) all.push_back(std::move(seen));
  }
  return all;
}

std::vector<SeenNoise> residual_noise(const Observations& data, const RunMotion& run) {
  std::vector<SeenNoise> all;
  for (const auto& source : data.lumen) {
    SeenNoise seen{NoiseOrigin::residual, source->facts().field(), {}, source->facts().noise, {}};
    for (SeenSeries& series : seen_series(*source, run, run.positions)) {
      for (const SeenFrame& frame : series.frames) seen.frames.push_back(name_of(*source, frame.frame));
      if (auto field = residual_field(std::move(series.frames), run)) seen.fields.push_back(std::move(*field));
    }
    if (!seen.fields.empty()) all.push_back(std::move(seen));
  }
  return all;
}

namespace {

/// Throws InputError for surfaces that are no two segmentations of one moment: what they differ by is no noise. A
/// segmentation errs by a voxel, a hundredth of a vessel's length, and by no less than a file rounds; fewer places than
/// twenty tell no correlation length.
void check_apart(const VectorXd& apart, Index points, double size) {
  constexpr Index least = 20;
  constexpr double same = 1e-6, farthest = 0.1;
  if (apart.size() < least)
    throw input_error("of {} points of the first {} lie beside the second: must be at least {}; other units?", points,
                      apart.size(), least);
  if (const double mean = apart.cwiseAbs().mean(); mean > farthest * size)
    throw input_error(
        "lie {:.3g} apart in the mean, the smaller is {:.3g} long: must be two surfaces of one moment in one unit",
        mean, size);
  if (root_mean_square(apart) < same * size)
    throw input_error("are the same surface: must be two segmentations, which differ by their noise");
}

}  // namespace

SeenNoise noise_between(const TriangleSurface& first, const TriangleSurface& second) {
  std::vector<Closest> closest = SignedSurface(second).closest(first.points);
  constexpr std::size_t most = 3000;  // five times what is used
  const std::size_t step = closest.size() / most + 1;
  std::vector<Index> used;
  for (std::size_t i = 0; i < closest.size(); i += step)
    if (!closest[i].on_rim) used.push_back(static_cast<Index>(i));
  Points normals(3, static_cast<Index>(used.size())), places = normals;
  VectorXd apart(normals.cols());
  for (Index i = 0; i < normals.cols(); ++i) {
    const Closest& at = closest[static_cast<std::size_t>(used[static_cast<std::size_t>(i)])];
    normals.col(i) = at.normal;
    // Midway: a place that has the first's errors in it would foretell them.
    places.col(i) = (first.points.col(used[static_cast<std::size_t>(i)]) + at.point) / 2;
    apart(i) = at.distance / std::sqrt(2);
  }
  check_apart(std::sqrt(2) * apart, first.points.cols(), std::min(box_size(first.points), box_size(second.points)));
  NoiseField field{places, offset_and_shift(places, normals), {}};
  field.frames.push_back({apart, MatrixXd(apart.size(), 0), 0});
  return {NoiseOrigin::repeated, "", {}, {}, {std::move(field)}};
}

}  // namespace tether
