#include "fsi_master/initial_state.hpp"

#include <cmath>

#include "common/base/checked_file.hpp"
#include "fsi_master/partners.hpp"
#include "fsi_master/periodicity.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* field = "initial_state.from";

/// Throws InputError that names the case's line.
template <class... Values>
void require(bool holds, const CaseFile& file, fmt::format_string<Values...> rule, Values&&... values) {
  if (!holds)
    throw input_error("{}: {}: {}", file.where(field), file.given(field),
                      fmt::format(rule, std::forward<Values>(values)...));
}

/// The state that a case names, as far as it can be looked at without a mesh.
Checkpoint saved_state(const InitialStateCase& given, const CaseFile& file) {
  Checkpoint saved;
  try {
    saved = read_checkpoint(given.from);
  } catch (const InputError& error) {
    throw input_error("{}: {}", file.where(field), error.what());
  }
  const StateOrigin& of = saved.origin;
  require(of.units == file.units().name(), file, "is in {}, this case in {}", of.units, file.units().name());
  const double image = file.common().image.pressure;
  require(of.image_pressure == image, file,
          "its pressures are relative to {:.6g} mmHg in the image, this case's to {:.6g}",
          file.units().to_mmhg(of.image_pressure), file.units().to_mmhg(image));
  return saved;
}

/// What the new clock means for what depends on time.
std::string what_time_changes(double time, double start, const std::optional<double>& period) {
  if (!period) return start == time ? "time goes on" : "what depends on time begins anew";
  const double jump = std::remainder(start - time, *period);
  if (std::abs(jump) <= 1e-6 * *period) return fmt::format("the phase of the beat of {:.4g} s is the same", *period);
  return fmt::format("inflows and motions jump by {:.4g} s of their beat of {:.4g} s (time.start: {:.6g} goes on)",
                     jump, *period, time);
}

}  // namespace

void InitialStateCase::declare(Fields& f) {
  f.path(
      "from", from,
      "output folder of a run: this one begins with the last state that it saved. The mesh, the units and the image's "
      "pressure must be the same; parameters, inflow, supports may be others. Time begins at time.start, and with it "
      "the phases of inflows and motions; pressures beyond outlets go on if the outlets are of the same types, else "
      "they begin as the case says",
      Need::required);
}

void InitialState::put(TimeLoop& loop) const {
  if (!loop.keeps_state())
    throw input_error("{}: a code of this case announces no state, and cannot begin there", where);
  try {
    loop.restore(snapshot);
  } catch (const StepFailure& failure) {
    throw input_error("{}: {}", where, failure.what());
  } catch (const InputError& error) {
    throw input_error("{}: {}", where, error.what());
  }
}

StateOrigin origin_of(const CaseFile& file, const Points& interface, std::uint64_t model) {
  return {file.units().name(),
          file.common().image.pressure,
          file.common().time.start,
          interface.cols(),
          static_cast<std::int64_t>(hash_values(interface, 0)),
          static_cast<std::int64_t>(model)};
}

InitialState initial_state_of(const InitialStateCase& given, const CaseFile& file, const StateOrigin& own) {
  Checkpoint saved = saved_state(given, file);
  const StateOrigin& of = saved.origin;
  require(of.nodes == own.nodes, file, "is of another mesh: its lumen has {} nodes, this one {}", of.nodes, own.nodes);
  require(of.places == own.places, file, "is of another mesh: the {} nodes of its lumen lie elsewhere", of.nodes);
  if (of.model != own.model) saved.snapshot.method.clear();
  const std::string place = fmt::format("{}: {}", file.where(field), file.given(field));
  const std::string notice = fmt::format(
      "initial state: {} after {} steps, at {:.6g} s; this run begins with it at {:.6g} s: {}", file.given(field),
      saved.step, of.time, own.time, what_time_changes(of.time, own.time, period_of_inlets(file.path(), file.units())));
  return {std::move(saved.snapshot), place, notice};
}

void check_initial_state(const InitialStateCase& given, const CaseFile& file) {
  saved_state(given, file);
}

}  // namespace tether
