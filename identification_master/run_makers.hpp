#pragma once

#include <vector>

#include "common/protocol/launch.hpp"

namespace tether {

/// Groups of processes that make whole runs, each one at a time.
class RunMakers {
 public:
  struct End {
    std::size_t group = 0;
    protocol::Simulated how;
    double cpu_seconds = 0;  ///< of all processes of the group, for this run
  };

  virtual ~RunMakers() = default;
  virtual const protocol::Hello& model() const = 0;
  virtual std::size_t groups() const = 0;
  virtual void begin(std::size_t group, const protocol::Simulate& run) = 0;
  /// Waits for the first group that has ended its run. Throws RunError if it cannot go on.
  virtual End next() = 0;
};

/// The same as processes.
class GroupRunMakers : public RunMakers {
 public:
  /// All groups have said hello.
  GroupRunMakers(protocol::Session& session, std::vector<protocol::Partner*> groups);

  const protocol::Hello& model() const override { return groups_.front()->hello(); }
  std::size_t groups() const override { return groups_.size(); }
  void begin(std::size_t group, const protocol::Simulate& run) override;
  End next() override;

 private:
  protocol::Session& session_;
  std::vector<protocol::Partner*> groups_, busy_;
  std::vector<double> cpu_seconds_;  ///< of each group so far
};

}  // namespace tether
