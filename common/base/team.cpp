#include "common/base/team.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace tether {
namespace {

class Alone final : public Team {
 public:
  Alone() : Team(0, 1) {}
  using Team::sum;
  void sum(std::span<double>) override {}
  void gather(std::span<double>, std::span<const int>) override {}
  void exchange(std::span<const Parcel>, std::span<const Parcel>) override {}
  std::string text_of(int, const std::string& text) override { return text; }
  int communicator() const override { throw InternalError("a team of one has no communicator"); }
};

}  // namespace

Team::Least Team::least(double value) {
  std::vector<double> all(static_cast<std::size_t>(size_));
  std::vector<int> starts(all.size() + 1);
  std::iota(starts.begin(), starts.end(), 0);
  all[static_cast<std::size_t>(rank_)] = value;
  gather(all, starts);
  const auto place = std::min_element(all.begin(), all.end(), [](double a, double b) {
    return std::isnan(a) ? !std::isnan(b) : a < b;  // what is no number is not to be overlooked
  });
  return {*place, static_cast<int>(place - all.begin())};
}

void Team::throw_if_any(bool failed, const std::string& failure) {
  const Least first = least(failed ? 0 : 1);
  if (first.value == 0) throw RunError(text_of(first.rank, failure));
}

Team& alone() {
  static Alone team;
  return team;
}

}  // namespace tether
