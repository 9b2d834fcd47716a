#include "observation_manager/measurements/lumen_series.hpp"

#include <algorithm>
#include <cmath>

#include "observation_manager/measurements/independence.hpp"

namespace tether {
namespace {

/// The part of the wall that a sample belongs to: a cube of four correlation lengths, within a region.
std::array<int, 4> patch_of(const Sample& sample, const Noise& noise) {
  std::array<int, 4> patch{sample.region};
  for (Eigen::Index i = 0; i < 3; ++i)
    patch[static_cast<std::size_t>(i) + 1] =
        static_cast<int>(std::floor(sample.position(i) / (4 * noise.correlation_length)));
  return patch;
}

/// Times of the frames of one contour or surface.
std::vector<double> times_of(const std::vector<Frame>& frames, int series) {
  std::vector<double> times;
  for (const Frame& frame : frames)
    if (frame.series == series) times.push_back(frame.time);
  return times;
}

double total_weight(const std::vector<Sample>& samples) {
  double sum = 0;
  for (const Sample& sample : samples) sum += sample.weight;
  return sum;
}

}  // namespace

std::vector<std::string> told(const std::vector<Note>& notes) {
  std::vector<std::pair<Note, int>> said;  // first, how many more
  for (const Note& note : notes) {
    const auto known = std::find_if(said.begin(), said.end(), [&](const auto& s) { return s.first.text == note.text; });
    if (known == said.end())
      said.emplace_back(note, 0);
    else
      ++known->second;
  }
  std::vector<std::string> all;
  for (const auto& [first, more] : said) {
    const std::string others = more > 0 ? fmt::format(" and {} more", more) : "";
    all.push_back(first.of.empty() ? first.text : first.of + others + ": " + first.text);
  }
  return all;
}

Sample between(const std::vector<Sample>& of_frames, const std::vector<FrameShare>& shares) {
  const auto is_seen = [](const Sample& sample) { return sample.excluded == Exclusion::none; };
  const bool whole = std::all_of(of_frames.begin(), of_frames.end(), is_seen);
  Sample sample;
  double distance = 0;
  Vec3 normal = Vec3::Zero();
  bool is_first = true;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Sample& here = of_frames[i];
    if (shares[i].of_chord != 0 && (is_first || (is_seen(sample) && !is_seen(here)))) sample = here, is_first = false;
    const double part = whole ? shares[i].of_curve : shares[i].of_chord;
    distance += part * here.distance;
    normal += part * here.normal;
  }
  sample.distance = distance;
  sample.normal = normal;
  return sample;
}

MeasurementFacts LumenSeries::facts() const {
  return {kind(), settings().name, settings().noise, dimension::length};
}

std::vector<MeasuredPart> LumenSeries::parts(const FinishedMotion& run) const {
  std::vector<MeasuredPart> all;
  for (const Frame& frame : frames())
    if (const auto time =
            time_in_run(frame.time, settings().period, run.motion.start, run.motion.end, settings().time_tolerance))
      all.push_back({frame, *time});
  return all;
}

std::vector<Datum> LumenSeries::data(const FinishedMotion& run, const MeasuredPart& part) const {
  const Noise& noise = settings().noise;
  const std::vector<Sample> samples = observe(run.motion.positions(part.time), part.frame);
  const double alone = independent_part(noise, sample_dimension(), total_weight(samples)),
               share = independent_share(spacing(times_of(frames(), part.frame.series), settings().period),
                                         noise.correlation_time);
  std::vector<Datum> all;
  all.reserve(samples.size());
  for (const Sample& sample : samples)
    all.push_back({.residual = sample.distance,
                   .is_seen = sample.excluded == Exclusion::none,
                   .independent = sample.weight / alone * share,
                   .time = part.time,
                   .held_out = part.frame.held_out,
                   .patch = patch_of(sample, noise),
                   .position = sample.position,
                   .region = sample.region,
                   .normal = sample.normal,
                   .nodes = sample.nodes,
                   .shares = sample.shares});
  return all;
}

CountedRows LumenSeries::rows(const Points& imaged, double start) const {
  const std::vector<std::string> names = series_names();
  std::vector<std::vector<double>> times(names.size());
  double any_time = start;
  for (const Frame& frame : frames())
    if (!frame.held_out) {
      times[static_cast<std::size_t>(frame.series)].push_back(frame.time);
      if (!std::isnan(frame.time)) any_time = frame.time;
    }
  CountedRows rows;
  rows.groups = names;
  std::vector<double> observed(names.size(), 0.0);
  const std::vector<Sample> samples = observe(imaged, any_time);
  rows.positions.resize(3, static_cast<Eigen::Index>(samples.size()));
  rows.normals.resize(3, rows.positions.cols());
  for (const Sample& sample : samples) {
    observed[static_cast<std::size_t>(sample.series)] += sample.weight;
    const auto row = static_cast<Eigen::Index>(rows.series_of.size());
    rows.positions.col(row) = sample.position;
    rows.normals.col(row) = sample.normal;
    rows.series_of.push_back(static_cast<std::size_t>(sample.series));
    rows.region.push_back(sample.region);
  }
  rows.group_of = rows.series_of;
  const Noise& noise = settings().noise;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    rows.series.push_back(
        {std::move(times[i]), settings().period, settings().time_tolerance, noise.correlation_time,
         1 / (std::pow(noise.deviation, 2) * independent_part(noise, sample_dimension(), observed[i]))});
  }
  return rows;
}

std::vector<SeenRow> LumenSeries::see(const ModelMoment& model, double time) const {
  std::vector<SeenRow> all;
  for (const Sample& sample : observe(model.lumen, time)) all.push_back({sample.distance, sample.weight});
  return all;
}

}  // namespace tether
