#include "common/io/point_series.hpp"

#include <algorithm>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

template <class Number>
void put(std::ostream& file, const Number* first, std::size_t count) {
  file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(Number)));
}

template <class Number>
bool get(std::istream& file, Number* first, std::size_t count) {
  return static_cast<bool>(
      file.read(reinterpret_cast<char*>(first), static_cast<std::streamsize>(count * sizeof(Number))));
}

std::string first_line(const PointSeriesKind& kind) {
  return kind.title + "\n";
}

std::uintmax_t header_size(const PointSeriesKind& kind, Eigen::Index points) {
  return first_line(kind).size() + sizeof(std::int64_t) + 3 * static_cast<std::uintmax_t>(points) * sizeof(double) +
         sizeof(std::uint64_t);
}

std::uintmax_t record_size(Eigen::Index points) {
  return sizeof(double) + 3 * static_cast<std::uintmax_t>(points) * sizeof(float) + sizeof(std::uint64_t);
}

std::uint64_t checksum_of(const Points& points) {
  return hash_bytes(points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
}

/// Of a record and of all before.
std::uint64_t checksum_of(double time, const float* vectors, std::size_t count, std::uint64_t before) {
  return hash_bytes(vectors, count * sizeof(float), hash_bytes(&time, sizeof time, before));
}

}  // namespace

PointSeriesWriter::PointSeriesWriter(PointSeriesKind kind, std::filesystem::path path, Points points)
    : kind_(std::move(kind)), path_(std::move(path)), points_(std::move(points)) {}

void PointSeriesWriter::start() {
  file_ = std::ofstream(path_, std::ios::binary | std::ios::trunc);
  file_ << first_line(kind_);
  const std::int64_t count = points_.cols();
  put(file_, &count, 1);
  put(file_, points_.data(), static_cast<std::size_t>(points_.size()));
  checksum_ = checksum_of(points_);
  put(file_, &checksum_, 1);
}

void PointSeriesWriter::resume(std::int64_t records, std::uint64_t checksum) {
  const PointSeries found(kind_, path_, records);
  if (found.points() != points_) throw input_error("{}: is the {} of another case", path_.string(), kind_.what);
  if (static_cast<std::int64_t>(found.times().size()) < records)
    throw input_error("{}: has {} records; the run to resume made {}", path_.string(), found.times().size(), records);
  if (found.checksum_after(records) != checksum)
    throw input_error("{}: is the {} of another run: not what the checkpoint belongs to", path_.string(), kind_.what);
  checksum_ = checksum;
  std::filesystem::resize_file(
      path_, header_size(kind_, points_.cols()) + static_cast<std::uintmax_t>(records) * record_size(points_.cols()));
  file_ = std::ofstream(path_, std::ios::binary | std::ios::app);
}

void PointSeriesWriter::append(double time, const Points& vectors) {
  const Eigen::Matrix<float, 3, Eigen::Dynamic> rounded = vectors.cast<float>();
  put(file_, &time, 1);
  const auto count = static_cast<std::size_t>(rounded.size());
  put(file_, rounded.data(), count);
  checksum_ = checksum_of(time, rounded.data(), count, checksum_);
  put(file_, &checksum_, 1);
  file_.flush();
  if (!file_) throw write_error(path_);
}

PointSeries::PointSeries(const PointSeriesKind& kind, const std::filesystem::path& path, std::int64_t most)
    : path_(path) {
  std::ifstream file = input_stream(path, std::ios::binary);
  std::string found(first_line(kind).size(), ' ');
  std::int64_t count = 0;
  const auto fitting = static_cast<std::int64_t>(std::filesystem::file_size(path) / (3 * sizeof(double)));
  if (!get(file, found.data(), found.size()) || found != first_line(kind) || !get(file, &count, 1) || count <= 0 ||
      count > fitting || header_size(kind, count) > std::filesystem::file_size(path))
    throw input_error("{}: is not the {}", path.string(), kind.what);
  points_.resize(3, count);
  get(file, points_.data(), static_cast<std::size_t>(points_.size()));
  std::uint64_t stated = 0;
  get(file, &stated, 1);
  checksums_.push_back(checksum_of(points_));
  if (stated != checksums_.back()) throw input_error("{}: its points are damaged (checksum)", path.string());
  std::vector<float> record(static_cast<std::size_t>(points_.size()));
  double time = 0;
  while (static_cast<std::int64_t>(times_.size()) < most && get(file, &time, 1) &&
         get(file, record.data(), record.size()) && get(file, &stated, 1)) {
    checksums_.push_back(checksum_of(time, record.data(), record.size(), checksums_.back()));
    if (stated != checksums_.back())
      throw input_error("{}: record {} is damaged (checksum)", path.string(), times_.size());
    times_.push_back(time);
    vectors_.insert(vectors_.end(), record.begin(), record.end());
  }
}

void PointSeries::check_has(std::int64_t steps) const {
  if (static_cast<std::int64_t>(times_.size()) <= steps)
    throw input_error("{}: is cut short: it has {} records of a run of {} steps", path_.string(), times_.size(), steps);
}

Points PointSeries::vectors(std::size_t record) const {
  const float* first = vectors_.data() + record * static_cast<std::size_t>(points_.size());
  return Eigen::Map<const Eigen::Matrix<float, 3, Eigen::Dynamic>>(first, 3, points_.cols()).cast<double>();
}

Points PointSeries::vectors_at(double time) const {
  const double tolerance = times_.size() > 1 ? 1e-6 * (times_.back() - times_.front()) : 0;
  if (times_.empty() || time < times_.front() - tolerance || time > times_.back() + tolerance)
    throw input_error("{}: the run does not reach the time {} s", path_.string(), time);
  const auto after = std::lower_bound(times_.begin(), times_.end(), time);
  const std::size_t b = std::min(static_cast<std::size_t>(after - times_.begin()), times_.size() - 1),
                    a = b > 0 ? b - 1 : 0;
  if (a == b || times_[b] <= time) return vectors(b);
  const double share = std::clamp((time - times_[a]) / (times_[b] - times_[a]), 0.0, 1.0);
  return (1 - share) * vectors(a) + share * vectors(b);
}

}  // namespace tether
