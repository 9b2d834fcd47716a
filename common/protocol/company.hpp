#pragma once

#include <memory>
#include <string>

#include "common/base/team.hpp"
#include "common/protocol/launch.hpp"

namespace tether::protocol {

/// The processes of one code that answer its master together (coupling.ranks): the first, their leader, hears the
/// requests and passes them on, all work on each, and the leader's answer counts. All construct it at the same time.
class Company {
 public:
  Company(const std::string& role, const Session& session);
  ~Company();
  Company(const Company&) = delete;
  Company& operator=(const Company&) = delete;

  Team& team();

  /// The leader's packet, in all.
  Packet shared(Packet of_leader);
  /// After work on a packet. `failure`: what went wrong here, empty if nothing did. In the leader: what went wrong in
  /// one of the others; they wait until it has asked. Where one of them has stopped working with the others, as by an
  /// error that only it met, no process can be relied upon any more: the leader's answer is a failure.
  std::string settled(const std::string& failure);
  /// What stops this process, which is not the leader, for good: it ends, and the leader tells.
  [[noreturn]] void give_up(const std::string& why) const;
  /// From now on processes may end.
  void part();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tether::protocol
