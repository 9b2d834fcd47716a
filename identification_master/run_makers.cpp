#include "identification_master/run_makers.hpp"

#include <algorithm>
#include <utility>

namespace tether {

using protocol::Partner;

GroupRunMakers::GroupRunMakers(protocol::Session& session, std::vector<Partner*> groups)
    : session_(session), groups_(std::move(groups)) {
  for (Partner* group : groups_) cpu_seconds_.push_back(group->ask(protocol::GetUsage{}).cpu_seconds);
}

void GroupRunMakers::begin(std::size_t group, const protocol::Simulate& run) {
  groups_[group]->send(run);
  busy_.push_back(groups_[group]);
}

RunMakers::End GroupRunMakers::next() {
  Partner& done = session_.first_to_reply(busy_);
  std::erase(busy_, &done);
  End end;
  end.group = static_cast<std::size_t>(std::find(groups_.begin(), groups_.end(), &done) - groups_.begin());
  end.how = done.receive<protocol::Simulated>();
  const double now = done.ask(protocol::GetUsage{}).cpu_seconds;
  end.cpu_seconds = now - std::exchange(cpu_seconds_[end.group], now);
  return end;
}

}  // namespace tether
