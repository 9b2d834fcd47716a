#include "twin/twin_data.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/curve.hpp"
#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "twin/closed_lumen.hpp"
#include "twin/noise.hpp"
#include "twin/voxels.hpp"

namespace tether {
namespace {

enum Purpose : std::uint64_t { of_grid = 1, of_surfaces, of_triangles };

std::uint64_t seed_of(const TwinCase& given, Purpose purpose) {
  return static_cast<std::uint64_t>(given.seed) * 16 + purpose;
}

/// The image's voxels, and how far beyond the vessel they reach.
struct Scanner {
  Vec3 voxel = Vec3::Zero(), shift = Vec3::Zero();
  double blur = 0;
  bool is_on() const { return voxel.minCoeff() > 0; }
  double reach() const { return 3 * voxel.maxCoeff() + 4 * blur; }
};

Scanner scanner_of(const TwinCase& given, const UnitSystem& units) {
  const auto length = [&](const char* text) { return units.quantity(text, dimension::length); };
  Scanner scanner{{length("0.6 mm"), length("0.6 mm"), length("1 mm")}, Vec3::Zero(), given.image.blur.value_or(0)};
  if (!given.image.voxel.empty()) scanner.voxel = Vec3(given.image.voxel.data());
  Random random(seed_of(given, of_grid), 0);
  for (int axis = 0; axis < 3; ++axis) scanner.shift[axis] = random.uniform() * scanner.voxel[axis];
  return scanner;
}

/// What of an imaged surface is the vessel's, and not that of the pieces drawn out behind its ends.
std::vector<bool> within_vessel(const TriangleSurface& imaged, const SignedSurface& closed, std::size_t own) {
  const std::vector<Closest> closest = closed.closest(imaged.points);
  std::vector<bool> keep;
  for (const Triangle& t : imaged.triangles)
    keep.push_back(std::all_of(t.begin(), t.end(), [&](int node) {
      return static_cast<std::size_t>(closest[static_cast<std::size_t>(node)].triangle) < own;
    }));
  return keep;
}

/// The lumen between the nodes of its mesh: two refinements leave facets a sixteenth as deep.
TriangleSurface round_lumen(const TriangleSurface& lumen, std::uint64_t seed) {
  return rounded(rounded(lumen, seed), seed + 1);
}

/// Throws InputError, beginning with `where`, if the voxels or the blur are so large that nothing is seen.
TriangleSurface imaged(const TriangleSurface& truth, const Scanner& scanner, const TwinImageCase& how,
                       const std::string& where) {
  TriangleSurface closed = closed_lumen(truth, scanner.reach());
  const VoxelImage image = coverage(closed, scanner.voxel, scanner.shift, scanner.reach());
  const TriangleSurface surface = segmented(image, {scanner.blur, how.mask, how.smoothing});
  std::vector<bool> keep;
  if (!surface.triangles.empty())
    keep = within_vessel(surface, SignedSurface(std::move(closed)), truth.triangles.size());
  if (std::none_of(keep.begin(), keep.end(), [](bool kept) { return kept; }))
    throw input_error("{}.image: nothing of the vessel is seen: its voxels or its blur are too large", where);
  return part_of(surface, keep);
}

/// Squares of the distances from the true nodes to a surface, where it is not open.
std::vector<double> squared_errors(const Points& truth, const TriangleSurface& surface) {
  std::vector<double> squares;
  for (const Closest& closest : SignedSurface(surface).closest(truth))
    if (!closest.on_rim) squares.push_back(closest.distance * closest.distance);
  return squares;
}

void move_along_normals(TriangleSurface& surface, const VectorXd& distance) {
  surface.points += nodal_normals(surface.points, surface.triangles) * distance.asDiagonal();
}

void check_frames(const TwinCase& given, const std::vector<double>& times, const TrueLumen& truth,
                  const std::string& where) {
  given.faults.check(given.frames, where + ".faults");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double time = times[i] + given.faults.delay(static_cast<int>(i));
    if (time < truth.start - 1e-9 || time > truth.end + 1e-9)
      throw input_error("{}: frame {} shows the time {:.6g}, but the truth's run is from {:.6g} to {:.6g}", where, i,
                        time, truth.start, truth.end);
  }
}

/// Of an image, which takes some 24 bytes for each, and of a trace.
constexpr double most_voxels = 5e7, most_values = 1e6;

std::string counted(double number) {
  return std::isfinite(number) ? fmt::format("{:.3g}", number) : "countless";
}

void check_image(const Scanner& scanner, const Vec3& extent, const WhereInCase& where) {
  const double largest = extent.maxCoeff();
  if (scanner.voxel.maxCoeff() > largest)
    throw input_error("{}: {:.4g}: must not be larger than the vessel, which is {:.4g} long", where("twin.image.voxel"),
                      scanner.voxel.maxCoeff(), largest);
  if (scanner.blur > largest)
    throw input_error("{}: {:.4g}: must not be larger than the vessel, which is {:.4g} long", where("twin.image.blur"),
                      scanner.blur, largest);
  const double voxels = ((extent.array() + 2 * scanner.reach()) / scanner.voxel.array() + 4).prod();
  if (!(voxels <= most_voxels))
    throw input_error("{}: would make {} voxels: must make at most {:.3g}", where("twin.image.voxel"), counted(voxels),
                      most_voxels);
}

}  // namespace

void check_scales(const TwinCase& given, const UnitSystem& units, const TrueLumen& truth, double first,
                  const WhereInCase& where) {
  const Points x = truth.positions(truth.start);
  const Vec3 extent = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
  if (const Scanner scanner = scanner_of(given, units); scanner.is_on()) check_image(scanner, extent, where);
  if (given.noise.deviation > extent.maxCoeff())
    throw input_error("{}: {:.4g}: must not be larger than the vessel, which is {:.4g} long",
                      where("twin.noise.deviation"), given.noise.deviation, extent.maxCoeff());
  for (const auto& [name, trace] : given.traces)
    if (const double values = (truth.end - first) / trace.interval; !(values <= most_values))
      throw input_error("{}: would make {} values: must make at most {:.3g}",
                        where("twin.traces." + name + ".interval"), counted(values), most_values);
}

std::vector<double> times_of_frames(const TwinCase& given, const TrueLumen& truth) {
  const double beat = given.beat.value_or(truth.end - truth.start), apart = beat / given.frames;
  const double first = given.first.value_or(truth.end - beat + apart);
  std::vector<double> times;
  for (int frame = 0; frame < given.frames; ++frame) times.push_back(first + frame * apart);
  return times;
}

TwinFrames make_frames(const TwinCase& given, const UnitSystem& units, const TrueLumen& truth,
                       const std::string& where) {
  const std::vector<double> times = times_of_frames(given, truth);
  check_frames(given, times, truth, where);
  const Scanner scanner = scanner_of(given, units);
  const NoiseSeries noise({given.noise.deviation, given.noise.correlation_length, given.noise.correlation_time}, times,
                          seed_of(given, of_surfaces));
  TwinFrames result;
  std::vector<double> errors;
  for (int frame = 0; frame < given.frames; ++frame) {
    if (given.faults.lose(frame)) continue;
    const auto i = static_cast<std::size_t>(frame);
    const double shown = std::clamp(times[i] + given.faults.delay(frame), truth.start, truth.end);
    const TriangleSurface lumen = round_lumen({truth.positions(shown), truth.triangles}, seed_of(given, of_triangles));
    TriangleSurface surface = scanner.is_on() ? imaged(lumen, scanner, given.image, where) : lumen;
    if (scanner.is_on())
      for (const double square : squared_errors(lumen.points, surface)) errors.push_back(square);
    move_along_normals(surface, noise(i, surface.points).array() + given.faults.moved_outward());
    given.faults.spoil(surface, lumen, frame);
    result.frames.push_back({frame, times[i], std::move(surface)});
  }
  double sum = 0;
  for (const double square : errors) sum += square;
  if (!errors.empty()) result.image_error = std::sqrt(sum / static_cast<double>(errors.size()));
  return result;
}

TwinTrace make_trace(const TwinTraceCase& given, const std::vector<double>& times, const std::vector<double>& values,
                     double first, std::uint64_t seed) {
  const Curve curve(times, values);
  TwinTrace trace;
  for (int k = 0; first + k * given.interval <= times.back() + 1e-9; ++k)
    trace.times.push_back(first + k * given.interval);
  const VectorXd noise = noise_over_time({given.noise.deviation, 0, given.noise.correlation_time}, trace.times, seed);
  for (std::size_t k = 0; k < trace.times.size(); ++k)
    trace.values.push_back(curve(trace.times[k] + given.faults.faults.delay(0)) + noise[static_cast<Eigen::Index>(k)]);
  given.faults.faults.spoil(trace.values);
  return trace;
}

}  // namespace tether
