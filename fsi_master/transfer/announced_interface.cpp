#include "fsi_master/transfer/announced_interface.hpp"

namespace tether {

InterfaceSurface ask_interface(protocol::Partner& partner) {
  const auto message = partner.ask(protocol::GetInterface{});
  const auto nodes = static_cast<std::int64_t>(message.points.size() / 3);
  if (message.points.size() % 3 != 0 || message.triangles.size() % 3 != 0 || nodes == 0)
    throw run_error("{}: interface of {} coordinates and {} triangle corners", partner.role(), message.points.size(),
                    message.triangles.size());
  InterfaceSurface surface{Eigen::Map<const Points>(message.points.data(), 3, nodes), {}};
  for (std::size_t i = 0; i < message.triangles.size(); i += 3) {
    Triangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::int64_t node = message.triangles[i + corner];
      if (node < 0 || node >= nodes)
        throw run_error("{}: interface triangle with node {} of {}", partner.role(), node, nodes);
      triangle[corner] = static_cast<int>(node);
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace tether
