#include "common/io/lumen_motion.hpp"

#include <algorithm>
#include <string>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr std::string_view title = "Tether lumen motion 1\n";

template <class Number>
void put(std::ostream& file, const Number* first, std::size_t count) {
  file.write(reinterpret_cast<const char*>(first), static_cast<std::streamsize>(count * sizeof(Number)));
}

template <class Number>
bool get(std::istream& file, Number* first, std::size_t count) {
  return static_cast<bool>(
      file.read(reinterpret_cast<char*>(first), static_cast<std::streamsize>(count * sizeof(Number))));
}

std::uintmax_t header_size(Eigen::Index nodes) {
  return title.size() + sizeof(std::int64_t) + 3 * static_cast<std::uintmax_t>(nodes) * sizeof(double);
}

std::uintmax_t record_size(Eigen::Index nodes) {
  return sizeof(double) + 3 * static_cast<std::uintmax_t>(nodes) * sizeof(float);
}

}  // namespace

LumenMotionWriter::LumenMotionWriter(std::filesystem::path path, Points imaged)
    : path_(std::move(path)), imaged_(std::move(imaged)) {}

void LumenMotionWriter::start() {
  file_.open(path_, std::ios::binary | std::ios::trunc);
  file_ << title;
  const std::int64_t nodes = imaged_.cols();
  put(file_, &nodes, 1);
  put(file_, imaged_.data(), static_cast<std::size_t>(imaged_.size()));
}

void LumenMotionWriter::resume(std::int64_t records) {
  const LumenMotion found(path_);
  if (found.imaged() != imaged_) throw input_error("{}: is the motion of another lumen", path_.string());
  if (static_cast<std::int64_t>(found.times().size()) < records)
    throw input_error("{}: has {} records; the run to resume made {}", path_.string(), found.times().size(), records);
  std::filesystem::resize_file(
      path_, header_size(imaged_.cols()) + static_cast<std::uintmax_t>(records) * record_size(imaged_.cols()));
  file_.open(path_, std::ios::binary | std::ios::app);
}

void LumenMotionWriter::append(double time, const Points& displacement) {
  const Eigen::Matrix<float, 3, Eigen::Dynamic> rounded = displacement.cast<float>();
  put(file_, &time, 1);
  put(file_, rounded.data(), static_cast<std::size_t>(rounded.size()));
  file_.flush();
  if (!file_) throw run_error("{} cannot be written", path_.string());
}

LumenMotion::LumenMotion(const std::filesystem::path& path) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw input_error("{}: no such file", path.string());
  std::string found(title.size(), ' ');
  std::int64_t nodes = 0;
  if (!get(file, found.data(), found.size()) || found != title || !get(file, &nodes, 1) || nodes <= 0 ||
      header_size(nodes) > std::filesystem::file_size(path))
    throw input_error("{}: is not the motion of a lumen", path.string());
  imaged_.resize(3, nodes);
  get(file, imaged_.data(), static_cast<std::size_t>(imaged_.size()));
  std::vector<float> record(static_cast<std::size_t>(imaged_.size()));
  double time = 0;
  while (get(file, &time, 1) && get(file, record.data(), record.size())) {
    times_.push_back(time);
    displacements_.insert(displacements_.end(), record.begin(), record.end());
  }
}

Points LumenMotion::displacement(std::size_t record) const {
  const float* first = displacements_.data() + record * static_cast<std::size_t>(imaged_.size());
  return Eigen::Map<const Eigen::Matrix<float, 3, Eigen::Dynamic>>(first, 3, imaged_.cols()).cast<double>();
}

Points LumenMotion::at(double time) const {
  const double tolerance = times_.size() > 1 ? 1e-6 * (times_.back() - times_.front()) : 0;
  if (times_.empty() || time < times_.front() - tolerance || time > times_.back() + tolerance)
    throw input_error("{}: the run does not reach the time {} s", path_.string(), time);
  const auto after = std::lower_bound(times_.begin(), times_.end(), time);
  const std::size_t b = std::min(static_cast<std::size_t>(after - times_.begin()), times_.size() - 1),
                    a = b > 0 ? b - 1 : 0;
  if (a == b) return imaged_ + displacement(b);
  const double share = std::clamp((time - times_[a]) / (times_[b] - times_[a]), 0.0, 1.0);
  return imaged_ + (1 - share) * displacement(a) + share * displacement(b);
}

}  // namespace tether
