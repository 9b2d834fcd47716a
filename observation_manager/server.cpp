#include "observation_manager/server.hpp"

#include "common/base/error.hpp"

namespace tether {
namespace {

protocol::Hello hello_of(const std::string& effective_case) {
  protocol::Hello hello;
  hello.program = "Tether observation_manager";
  hello.effective_case = effective_case;
  return hello;
}

protocol::Ready refuse_all(const protocol::SetParameters& m) {
  if (!m.names.empty()) throw input_error("the measurements have no parameter {}", m.names.front());
  return {};
}

}  // namespace

protocol::Discrepancy as_message(const std::vector<Sample>& samples) {
  protocol::Discrepancy m;
  for (const Sample& s : samples) {
    m.distances.push_back(s.distance);
    m.normals.insert(m.normals.end(), s.normal.begin(), s.normal.end());
    m.weights.push_back(s.weight);
    m.nodes.insert(m.nodes.end(), s.nodes.begin(), s.nodes.end());
    m.shares.insert(m.shares.end(), s.shares.begin(), s.shares.end());
    m.sources.push_back(s.source);
    m.exclusions.push_back(static_cast<std::int64_t>(s.excluded));
  }
  return m;
}

protocol::FlowDiscrepancy as_message(const std::vector<FlowSample>& samples) {
  protocol::FlowDiscrepancy m;
  for (const FlowSample& s : samples) {
    m.differences.push_back(s.difference);
    m.deviations.push_back(s.deviation);
    m.sources.push_back(s.source);
    m.exclusions.push_back(static_cast<std::int64_t>(s.excluded));
  }
  return m;
}

protocol::Hello ObservationServer::hello() const {
  protocol::Hello hello = hello_of(effective_case_);
  hello.notices = observations_.notes();
  return hello;
}

protocol::Ready ObservationServer::operator()(const protocol::SetParameters& m) {
  return refuse_all(m);
}

protocol::Discrepancy ObservationServer::operator()(const protocol::Observe& m) {
  if (m.points.size() != 3 * static_cast<std::size_t>(nodes_))
    throw run_error("the lumen has {} numbers; its {} nodes in the case's mesh need {}", m.points.size(), nodes_,
                    3 * nodes_);
  return as_message(observations_.observe(Eigen::Map<const Points>(m.points.data(), 3, nodes_), m.time));
}

protocol::Hello FlowObservationServer::hello() const {
  protocol::Hello hello = hello_of(effective_case_);
  for (const Trace& trace : observations_.traces)
    hello.observables.push_back({trace.name, units_.symbol(trace.dimension)});
  for (const VelocitySeries& series : observations_.velocities)
    hello.observables.push_back({series.settings().name, units_.symbol(dimension::velocity)});
  return hello;
}

protocol::Interface FlowObservationServer::operator()(const protocol::GetInterface&) const {
  const Points points = observations_.points();
  return {{points.data(), points.data() + points.size()}, {}, {}, {}};
}

protocol::Ready FlowObservationServer::operator()(const protocol::SetParameters& m) {
  return refuse_all(m);
}

protocol::FlowDiscrepancy FlowObservationServer::operator()(const protocol::ObserveFlow& m) const {
  const Eigen::Index points = observations_.points().cols();
  if (m.names.size() != m.values.size()) throw run_error("{} names, but {} values", m.names.size(), m.values.size());
  if (m.velocities.size() != 3 * static_cast<std::size_t>(points))
    throw run_error("{} numbers of velocity; {} points need {}", m.velocities.size(), points, 3 * points);
  const ModelFlow model{m.names, m.values, Eigen::Map<const Points>(m.velocities.data(), 3, points)};
  return as_message(observations_.observe(model, m.time));
}

}  // namespace tether
