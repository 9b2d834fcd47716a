#include "observation_manager/measurements/contour_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/base/shortened.hpp"
#include "observation_manager/measurements/stated_unit.hpp"

namespace tether {
namespace {

/// One contour of one frame, as the file has it.
struct Drawn {
  std::string slice, contour, where;
  double frame = 0, time = 0;
  bool closed = true;
  Points points;
};

/// Of one frame: the model's lumen is cut for each of them.
constexpr std::size_t most_contours = 2000;

class Table {
 public:
  Table(const SlicesCase& given, const UnitSystem& units)
      : table_(given.file),
        slice_(table_.names("slice")),
        contour_(table_.has("contour") ? table_.names("contour") : std::vector<std::string>(table_.rows())),
        frame_(table_.numbers("frame")),
        time_(table_.quantities("time", units, dimension::time)),
        closed_(table_.has("closed") ? table_.numbers("closed") : std::vector<double>(table_.rows(), 1.0)) {
    check_unit_of_time(table_, given.beat.has_value());
    check_names_and_frames();
    for (std::size_t row = 0; row < closed_.size(); ++row)
      if (closed_[row] != 0 && closed_[row] != 1)
        throw input_error("{}: closed: {:g}: must be 1 (closed) or 0 (a line with two ends)", table_.where(row),
                          closed_[row]);
    for (const char* axis : {"x", "y", "z"}) {
      const std::string unit = given.unit == "heading" ? table_.unit(axis) : given.unit;
      if (unit.empty())
        throw input_error("{}: the unit of {} is stated neither in its heading ({} [mm]) nor in the case (unit)",
                          given.file.string(), axis, axis);
      x_.push_back(table_.quantities(axis, units, dimension::length, unit));
    }
    for (double& time : time_) time *= given.beat.value_or(1.0);
  }

  std::vector<Drawn> drawn() const {
    std::vector<Drawn> all;
    std::map<std::tuple<std::string, std::string, double>, std::size_t> seen;
    for (std::size_t row = 0, end = 0; row < table_.rows(); row = end) {
      const auto key = [&](std::size_t i) { return std::tuple(slice_[i], contour_[i], frame_[i]); };
      if (!seen.emplace(key(row), row).second)
        throw input_error("{}: slice {}, frame {:g} occurs in two places: the rows of a contour must stand together",
                          table_.where(row), slice_[row], frame_[row]);
      while (end < table_.rows() && key(end) == key(row)) ++end;
      all.push_back(rows(row, end));
    }
    return all;
  }

 private:
  void check_names_and_frames() const {
    constexpr double most = 1e6;
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      if (slice_[row].empty()) throw input_error("{}: slice: '': {}", table_.where(row), name_rule);
      if (!(frame_[row] >= 0 && frame_[row] <= most && frame_[row] == std::round(frame_[row])))
        throw input_error("{}: frame: {}: must be a whole number from 0 to {:.0f}", table_.where(row), frame_[row],
                          most);
    }
  }

  Drawn rows(std::size_t begin, std::size_t end) const {
    Drawn one{
        slice_[begin], contour_[begin], table_.where(begin), frame_[begin], time_[begin], closed_[begin] != 0, {}};
    one.points.resize(3, static_cast<Eigen::Index>(end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      if (time_[i] != one.time)
        throw input_error("{}: slice {}, frame {:g} has two times, {:g} and {:g}", table_.where(i), one.slice,
                          one.frame, one.time, time_[i]);
      if (closed_[i] != closed_[begin])
        throw input_error("{}: slice {}, frame {:g} is both closed and not", table_.where(i), one.slice, one.frame);
      one.points.col(static_cast<Eigen::Index>(i - begin)) << x_[0][i], x_[1][i], x_[2][i];
    }
    return one;
  }

  CsvTable table_;
  std::vector<std::string> slice_, contour_;
  std::vector<double> frame_, time_, closed_;
  std::vector<std::vector<double>> x_;
};

SlicePlane plane_of(const std::string& slice, const std::vector<const Drawn*>& drawn) {
  Eigen::Index count = 0;
  for (const Drawn* one : drawn) count += one->points.cols();
  Points all(3, count);
  for (const Drawn* one : drawn) {
    count -= one->points.cols();
    all.middleCols(count, one->points.cols()) = one->points;
  }
  const auto [plane, deviation] = fitted_plane(drawn.front()->where + ": slice " + slice, all);
  const double size = (all.colwise() - plane.origin).colwise().norm().maxCoeff();
  if (deviation > 0.02 * size)
    throw input_error("{}: slice {} is not flat: its points lie up to {:.3g} off a plane, its size is {:.3g}",
                      drawn.front()->where, slice, deviation, 2 * size);
  return plane;
}

/// Points of the plane, each once.
Eigen::Matrix2Xd flat_points(const Drawn& one, const SlicePlane& plane, int& repeated) {
  std::vector<Vec2> kept;
  for (const auto& x : one.points.colwise())
    if (const Vec2 p = plane.flat(x); kept.empty() || p != kept.back())
      kept.push_back(p);
    else
      ++repeated;
  if (one.closed && kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  const std::size_t least = one.closed ? 3 : 2;
  if (kept.size() < least)
    throw input_error("{}: slice {}, frame {:g} has {} different points: at least {} are needed", one.where, one.slice,
                      one.frame, kept.size(), least);
  Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = kept[i];
  return points;
}

/// A contour said to be closed whose ends lie far apart is an arc: its chord would count as measured.
void check_closed(const Drawn& one, const Contour& contour) {
  constexpr double steps = 3, share = 0.1;  // of its longest other step, of its length
  const Eigen::Index count = contour.points().cols();
  double longest = 0;
  for (Eigen::Index i = 1; i < count; ++i)
    longest = std::max(longest, (contour.points().col(i) - contour.points().col(i - 1)).norm());
  const double gap = (contour.points().col(0) - contour.points().col(count - 1)).norm();
  if (gap > steps * longest && gap > share * contour.length())
    throw input_error(
        "{}: slice {}, frame {:g}: counts as closed, but its ends are {:.3g} apart, and no two other neighbours more "
        "than {:.3g}: is it a line with two ends (column closed: 0)?",
        one.where, one.slice, one.frame, gap, longest);
}

Contour contour_of(const Drawn& one, const SlicePlane& plane, int& repeated) {
  const Contour contour(flat_points(one, plane, repeated), one.closed);
  if (contour.crosses_itself())
    throw input_error("{}: slice {}, frame {:g}: the contour crosses itself", one.where, one.slice, one.frame);
  if (one.closed) check_closed(one, contour);
  return one.closed && contour.signed_area() < 0 ? contour.reversed() : contour;
}

/// Adds a frame to the track it belongs to.
void add(ContourTrack& track, const Drawn& one, const SlicesCase& given, int& repeated) {
  const double time = one.time + given.data.time_shift;
  if (!track.times.empty() && !(time > track.times.back()))
    throw input_error("{}: the time {:g} of {}, frame {:g} does not come after {:g}", one.where, one.time, track.name,
                      one.frame, track.times.back() - given.data.time_shift);
  if (const double period = given.beat.value_or(given.period.value_or(0));
      period > 0 && !track.times.empty() && time > track.times.front() + period * (1 - 1e-9))
    throw input_error("{}: the time {:g} of {}, frame {:g} lies beyond one period of {:g}", one.where, one.time,
                      track.name, one.frame, period);
  track.times.push_back(time);
  track.contours.push_back(contour_of(one, track.plane, repeated));
  const auto& out = given.data.held_out;
  track.labels.push_back(one.frame);
  track.held_out.push_back(std::find(out.begin(), out.end(), one.frame) != out.end());
}

/// Each of them once, as messages list them.
template <class Get>
std::string different(const std::vector<Drawn>& drawn, const Get& get) {
  constexpr std::size_t most = 500;
  std::set<std::decay_t<decltype(get(drawn.front()))>> all;
  for (const Drawn& one : drawn) all.insert(get(one));
  return shortened(fmt::format("{}", fmt::join(all, ", ")), most);
}

void check_frames(const std::vector<Drawn>& drawn, const SlicesCase& given) {
  const auto frame_of = [](const Drawn& one) { return one.frame; };
  std::set<double> frames;
  for (const Drawn& one : drawn) frames.insert(frame_of(one));
  for (const auto& [field, numbers] : {std::pair{"held_out", &given.data.held_out}, {"left_out", &given.data.left_out}})
    for (const double number : *numbers)
      if (!frames.contains(number))
        throw input_error("{}: {}: there is no frame {:g}; its frames are {}", given.file.string(), field, number,
                          different(drawn, frame_of));
}

/// Only the frames that the case does not leave out, where they should be.
void correct(std::vector<Drawn>& drawn, const SlicesCase& given) {
  const auto& out = given.data.left_out;
  std::erase_if(drawn, [&](const Drawn& one) { return std::find(out.begin(), out.end(), one.frame) != out.end(); });
  if (drawn.empty()) throw input_error("{}: left_out: no frame is left", given.file.string());
  for (Drawn& one : drawn) one.points = given.data.correction.faults.corrected(one.points);
}

/// Only the slices that the case names.
void keep_wanted(std::vector<Drawn>& drawn, const SlicesCase& given) {
  if (given.slices.empty()) return;
  for (const std::string& name : given.slices)
    if (std::none_of(drawn.begin(), drawn.end(), [&](const Drawn& one) { return one.slice == name; }))
      throw input_error("{}: has no slice {}; it has {}", given.file.string(), shortened(name),
                        different(drawn, [](const Drawn& one) { return one.slice; }));
  std::erase_if(drawn, [&](const Drawn& one) {
    return std::find(given.slices.begin(), given.slices.end(), one.slice) == given.slices.end();
  });
}

}  // namespace

std::vector<ContourTrack> read_contour_tracks(const SlicesCase& given, const UnitSystem& units,
                                              std::vector<Note>& notes) {
  std::vector<Drawn> drawn = Table(given, units).drawn();
  keep_wanted(drawn, given);
  check_frames(drawn, given);
  correct(drawn, given);
  std::map<std::string, std::vector<const Drawn*>> of_slice;
  for (const Drawn& one : drawn) of_slice[one.slice].push_back(&one);
  std::map<std::string, SlicePlane> planes;
  for (const auto& [slice, its] : of_slice) planes.emplace(slice, plane_of(slice, its));

  std::vector<ContourTrack> tracks;
  std::map<std::string, std::size_t> places;  ///< of tracks, by their names
  int repeated = 0;
  for (const Drawn& one : drawn) {
    const std::string name = "slice " + one.slice + (one.contour.empty() ? "" : ", " + one.contour);
    const auto [place, is_new] = places.emplace(name, tracks.size());
    if (is_new && tracks.size() == most_contours)
      throw input_error(
          "{}: has more than {} slices and contours: must be at most so many, each in any number of frames",
          given.file.string(), most_contours);
    if (is_new) tracks.push_back({name, planes.at(one.slice), {}, {}, {}});
    add(tracks[place->second], one, given, repeated);
  }
  if (repeated > 0) notes.push_back({"", fmt::format("{} points that repeat the one before are left out", repeated)});
  return tracks;
}

}  // namespace tether
