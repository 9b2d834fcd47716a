#include "diagnosis/explanation/explained_distances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/evidence/data_errors.hpp"

namespace tether {

std::optional<Misfit> misfit_of(const EffectProblem& problem, const Evidence& evidence, const VectorXd& residual,
                                const std::vector<Eigen::Index>& rows) {
  double squares = 0, precision = 0, count = 0;
  for (const auto& part : evidence.parts())
    if (evidence.fallible(part).in_place)
      for (const Eigen::Index i : rows)
        if (i >= part.first && i < part.first + part.count) {
          squares += problem.precision(i) * residual(i) * residual(i);
          precision += problem.precision(i);
          count += problem.independent(i);
        }
  if (!(precision > 0)) return std::nullopt;
  return Misfit{std::sqrt(squares / precision), std::sqrt(squares / count)};
}

std::optional<Gain> gain_between(const EffectProblem& problem, const VectorXd& before, const VectorXd& after) {
  const auto& rows = problem.held_out;
  if (rows.size() < 2) return std::nullopt;
  std::vector<int> block;
  for (const Eigen::Index i : rows) block.push_back(problem.block[static_cast<std::size_t>(i)]);
  return gain_of(problem.precision(rows), block, before(rows), after(rows), problem.independent(rows).sum());
}

std::vector<std::string> odd_frames(const Evidence& evidence, const EffectProblem& problem, const VectorXd& residual,
                                    const std::vector<FrameOfSource>& known) {
  constexpr double much = 2;  // times the median, and the noise
  constexpr std::size_t few = 4;
  std::vector<std::pair<double, const Evidence::Part*>> off;
  for (const auto& part : evidence.parts()) {
    if (!evidence.fallible(part).in_place) continue;
    std::vector<Eigen::Index> rows(static_cast<std::size_t>(part.count));
    std::iota(rows.begin(), rows.end(), part.first);
    if (const auto misfit = misfit_of(problem, evidence, residual, rows); misfit && misfit->in_noise > 0)
      off.emplace_back(misfit->in_noise, &part);
  }
  if (off.size() < few) return {};
  std::vector<double> sizes;
  for (const auto& [size, part] : off) sizes.push_back(size);
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<long>(sizes.size() / 2), sizes.end());
  const double median = sizes[sizes.size() / 2];
  std::vector<std::string> all;
  for (const auto& [size, part] : off) {
    const FrameOfSource frame{evidence.field_of(*part), part->frame.label};
    const bool is_known = std::find(known.begin(), known.end(), frame) != known.end();
    if (!is_known && size > much * std::max(1.0, median))
      all.push_back(fmt::format(
          "Look at the{} frame of {} at {:.3g} s: {:.1f} times the noise off the last model, most frames {:.1f}",
          part->frame.held_out ? " held-out" : "", evidence.name_of(*part), part->frame.time, size, median));
  }
  return all;
}

}  // namespace tether
