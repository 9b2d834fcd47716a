#include "fsi_master/run_guide.hpp"

namespace tether {
namespace {

/// The file: the number of unknowns as int64; for each step a mark, 1 if it is known, and its change.
constexpr std::streamoff head = sizeof(std::int64_t);
constexpr float known = 1;

std::ios::openmode mode_of(RunGuide::Role role) {
  return role == RunGuide::Role::guide ? std::ios::out | std::ios::binary | std::ios::trunc
                                       : std::ios::in | std::ios::binary;
}

}  // namespace

RunGuide::RunGuide(const std::filesystem::path& folder, Role role, double dt)
    : role_(role), dt_(dt), file_(folder / "coupling.changes", mode_of(role)) {
  if (role_ == Role::follower) file_.read(reinterpret_cast<char*>(&unknowns_), head);
}

std::streamoff RunGuide::place_of(const StepStart& start) const {
  return head + (start.step - 1) * (1 + unknowns_) * static_cast<std::streamoff>(sizeof(float));
}

VectorXd RunGuide::change_in(const StepStart& start) {
  if (role_ == Role::guide || start.dt != dt_ || unknowns_ == 0) return {};
  Eigen::VectorXf record = Eigen::VectorXf::Zero(1 + unknowns_);
  file_.clear();
  file_.seekg(place_of(start));
  file_.read(reinterpret_cast<char*>(record.data()), record.size() * static_cast<std::streamoff>(sizeof(float)));
  if (!file_ || record(0) != known) return {};
  return record.tail(unknowns_).cast<double>();
}

void RunGuide::keep(const StepStart& start, const VectorXd& change) {
  if (role_ == Role::follower || start.dt != dt_ || change.size() == 0) return;
  if (unknowns_ == 0) {
    unknowns_ = change.size();
    file_.write(reinterpret_cast<const char*>(&unknowns_), head);
  }
  Eigen::VectorXf record(1 + unknowns_);
  record << known, change.cast<float>();
  file_.seekp(place_of(start));  // steps that were passed over read as zeros
  file_.write(reinterpret_cast<const char*>(record.data()), record.size() * static_cast<std::streamoff>(sizeof(float)));
}

}  // namespace tether
