#include "observation_manager/server.hpp"

#include "common/base/error.hpp"

namespace tether {
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

protocol::Hello ObservationServer::hello() const {
  protocol::Hello hello;
  hello.program = "Tether observation_manager";
  hello.effective_case = effective_case_;
  hello.notices = observations_.notes();
  return hello;
}

protocol::Ready ObservationServer::operator()(const protocol::SetParameters& m) {
  if (!m.names.empty()) throw input_error("the measurements have no parameter {}", m.names.front());
  return {};
}

protocol::Discrepancy ObservationServer::operator()(const protocol::Observe& m) {
  if (m.points.size() != 3 * static_cast<std::size_t>(nodes_))
    throw run_error("the lumen has {} numbers; its {} nodes in the case's mesh need {}", m.points.size(), nodes_,
                    3 * nodes_);
  return as_message(observations_.observe(Eigen::Map<const Points>(m.points.data(), 3, nodes_), m.time));
}

}  // namespace tether
