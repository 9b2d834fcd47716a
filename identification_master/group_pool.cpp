#include "identification_master/group_pool.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "common/base/error.hpp"

namespace tether {
namespace {

using protocol::Partner;

std::string described(const NamedValues& values) {
  std::string text;
  for (std::size_t i = 0; i < values.names.size(); ++i)
    text += fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", values.names[i], values.values[i]);
  return text;
}

}  // namespace

GroupPool::GroupPool(protocol::Session& session, std::vector<Partner*> groups)
    : session_(session), groups_(std::move(groups)) {
  for (Partner* group : groups_)
    if (!group->hello().has_state)
      throw input_error(
          "identification needs codes that announce states; fluid or solid of this case does not (docs/protocol.md)");
}

VectorXd GroupPool::initial_state() {
  const auto state = groups_.front()->ask(protocol::GetState{});
  return Eigen::Map<const VectorXd>(state.values.data(), static_cast<Eigen::Index>(state.values.size()));
}

Points GroupPool::lumen() {
  const auto interface = groups_.front()->ask(protocol::GetInterface{});
  imaged_ =
      Eigen::Map<const Points>(interface.points.data(), 3, static_cast<Eigen::Index>(interface.points.size() / 3));
  return imaged_;
}

/// A state ends with the interface's displacement and velocity.
Points GroupPool::lumen_in(const std::vector<double>& state) const {
  if (static_cast<Eigen::Index>(state.size()) < 2 * imaged_.size()) return Points(3, 0);
  return imaged_ + Eigen::Map<const Points>(state.data() + state.size() - 2 * imaged_.size(), 3, imaged_.cols());
}

protocol::Usage GroupPool::usage() {
  protocol::Usage all;
  for (Partner* group : groups_) {
    const auto usage = group->ask(protocol::GetUsage{});
    all.cpu_seconds += usage.cpu_seconds;
    all.peak_memory_mb += usage.peak_memory_mb;
  }
  return all;
}

std::vector<std::vector<double>> GroupPool::at_hand() {
  std::vector<std::vector<double>> states;
  for (Partner* group : groups_) group->send(protocol::GetState{});
  for (Partner* group : groups_) states.push_back(group->receive<protocol::State>().values);
  return states;
}

void GroupPool::take_up(const std::vector<std::vector<double>>& states) {
  const std::size_t count = std::min(states.size(), groups_.size());
  for (std::size_t g = 0; g < count; ++g) groups_[g]->send(protocol::SetState{states[g]});
  for (std::size_t g = 0; g < count; ++g) groups_[g]->receive<protocol::Ready>();
}

void GroupPool::deal(std::size_t count, const std::function<protocol::Advance(std::size_t)>& request,
                     const std::function<void(std::size_t, protocol::Advanced)>& take) {
  std::vector<Partner*> busy;
  std::vector<std::size_t> work;  // of each busy group
  const auto begin = [&](Partner* group, std::size_t particle) {
    group->send(request(particle));
    busy.push_back(group);
    work.push_back(particle);
  };
  for (std::size_t g = 0; g < std::min(count, groups_.size()); ++g) begin(groups_[g], g);
  while (!busy.empty()) {
    Partner* done = &session_.first_to_reply(busy);
    const auto place = std::find(busy.begin(), busy.end(), done) - busy.begin();
    const std::size_t which = work[static_cast<std::size_t>(place)];
    try {
      take(which, done->receive<protocol::Advanced>());
    } catch (const protocol::PartnerFailed& failure) {
      const protocol::Advance failed = request(which);
      throw run_error("sigma point {} of {} ({}): {}", which + 1, count, described({failed.names, failed.values}),
                      failure.what());
    }
    busy.erase(busy.begin() + place);
    work.erase(work.begin() + place);
    if (which + groups_.size() < count) begin(done, which + groups_.size());
  }
}

std::vector<ParticleReport> GroupPool::advance(const EnsembleStep& step, const std::vector<NamedValues>& values,
                                               MatrixXd& states, std::vector<std::vector<double>>& memories) {
  std::vector<ParticleReport> reports(values.size());
  const auto request = [&](std::size_t i) {
    const auto state = states.col(static_cast<Eigen::Index>(i));
    return protocol::Advance{
        step.number, step.time, step.dt, step.observe, values[i].names, values[i].values, {state.begin(), state.end()},
        memories[i]};
  };
  const auto take = [&](std::size_t i, protocol::Advanced reply) {
    if (static_cast<Eigen::Index>(reply.state.size()) != states.rows())
      throw run_error("sigma point {} of {} came back with {} numbers instead of {}", i + 1, values.size(),
                      reply.state.size(), states.rows());
    states.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const VectorXd>(reply.state.data(), states.rows());
    memories[i] = std::move(reply.memory);
    reports[i] = {
        std::move(reply.observables), std::move(reply.distances), std::move(reply.weights), std::move(reply.velocities),
        lumen_in(reply.state),        reply.evaluations,          reply.krylov_iterations,  reply.parts};
  };
  deal(values.size(), request, take);
  return reports;
}

}  // namespace tether
