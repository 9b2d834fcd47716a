#include "observation_manager/measurements/faults/fault.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"

namespace tether {

void ConcernedFrame::declare(Fields& f) {
  f.integer("frame", number, {-1}, "number of the frame, from 0; -1: all");
}

void ConcernedFrame::check(int frames, const std::string& where) const {
  if (number >= frames) throw input_error("{}: frame {} of {}, counted from 0", where, number, frames);
}

Vec3 vector_of(const std::vector<double>& numbers) {
  return numbers.size() == 3 ? Vec3(numbers.data()) : Vec3::Zero();
}

std::string list_text(const Vec3& v) {
  const Vec3 without_minus_zero = v.array() + 0.0;
  return fmt::format("[{}, {}, {}]", number_text(without_minus_zero(0)), number_text(without_minus_zero(1)),
                     number_text(without_minus_zero(2)));
}

}  // namespace tether
