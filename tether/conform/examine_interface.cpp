/// Who the partner is, and its surface.
#include <map>
#include <set>

#include "fsi_master/transfer/announced_interface.hpp"
#include "fsi_master/transfer/interface_fit.hpp"
#include "fsi_master/transfer/interface_map.hpp"
#include "tether/conform/examiner.hpp"

namespace tether::protocol {

std::string Examiner::hello() {
  const Hello& hello = partner_.hello();
  require(!hello.program.empty(), "the program has no name");
  require(!hello.has_state || hello.state_size > 0, "announces states of size {}: must be above 0", hello.state_size);
  require(!hello.has_operators || hello.unknowns > 0, "announces operators for {} unknowns: must be above 0",
          hello.unknowns);
  std::set<std::string> names;
  for (const auto& p : hello.parameters) {
    require(!p.name.empty() && names.insert(p.name).second, "the parameter name \"{}\" is empty or not unique", p.name);
    require(p.value >= p.lower && p.value <= p.upper, "parameter {}: {} is not in [{}, {}]", p.name, p.value, p.lower,
            p.upper);
  }
  return fmt::format("{}: {}, {} parameters, {} observables", partner_.role(), hello.program, hello.parameters.size(),
                     hello.observables.size());
}

std::string Examiner::surface() {
  surface_ = partner_.ask(GetInterface{});
  const auto nodes = static_cast<std::int64_t>(surface_.points.size() / 3);
  const std::size_t triangles = surface_.triangles.size() / 3;
  require(nodes >= 3 && surface_.points.size() % 3 == 0, "{} coordinates: must be 3 for each of at least 3 nodes",
          surface_.points.size());
  require(triangles > 0 && surface_.triangles.size() % 3 == 0,
          "{} triangle corners: must be 3 for each of at least one triangle", surface_.triangles.size());
  require(all_finite(surface_.points), "a coordinate is not finite");
  std::vector<bool> used(static_cast<std::size_t>(nodes));
  for (const std::int64_t corner : surface_.triangles) {
    require(corner >= 0 && corner < nodes, "a triangle has the node {}, there are {}", corner, nodes);
    used[static_cast<std::size_t>(corner)] = true;
  }
  require(std::find(used.begin(), used.end(), false) == used.end(), "node {} belongs to no triangle",
          std::find(used.begin(), used.end(), false) - used.begin());
  const auto& regions = surface_.regions;
  require(regions.empty() || regions.size() == triangles, "{} regions for {} triangles: must be one for each, or none",
          regions.size(), triangles);
  for (const std::int64_t region : regions)
    require(region >= -1 && region < static_cast<std::int64_t>(surface_.region_names.size()), "region {} has no name",
            region);
  drive_.emplace(partner_, surface_, dt_);
  return fmt::format("{} nodes, {} triangles", nodes, triangles);
}

std::string Examiner::orientation() {
  std::map<std::pair<std::int64_t, std::int64_t>, int> edges;
  for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto edge = std::pair(surface_.triangles[i], surface_.triangles[next]);
    require(++edges[edge] == 1, "two triangles run from node {} to node {}: they look to opposite sides", edge.first,
            edge.second);
  }
  const double outwardness = Shape(surface_).outwardness;
  require(outwardness > 0, "the triangles look inward");
  return "";
}

std::string Examiner::fit() {
  if (!counterpart_) throw Skipped("no other code is named (--with PROGRAM)");
  const InterfaceSurface own = ask_interface(partner_), others = ask_interface(counterpart_->partner);
  const bool is_fluid = partner_.role() == "fluid";
  const InterfaceSurface &fluid = is_fluid ? own : others, &solid = is_fluid ? others : own;
  const double size = diagonal(solid.points), trust = trusted_distance * size;
  const UnitSystem& units = counterpart_->units;
  const bool matches = InterfaceMap::matches(fluid, solid, same_node * size);
  const InterfaceMap map = matches ? InterfaceMap::match(fluid, solid, same_node * size, units)
                                   : InterfaceMap::mortar(fluid, solid, trust, units);
  const InterfaceFit fit = interface_fit(fluid, solid, trust);
  require(!fit.looks_away(), "its triangles look to the side opposite to those of {}",
          counterpart_->partner.hello().program);
  const VectorXd load = VectorXd::Random(fluid.points.size()), motion = VectorXd::Random(solid.points.size());
  const InterfaceBalance lost = map.balance({load.begin(), load.end()}, motion);
  const double most = std::max({lost.force, lost.moment, lost.work});
  require(most < balance_tolerance, "force, moment or work are kept to {:.1e} only", most);
  if (matches) return fmt::format("node for node, {} of them", fit.fluid_nodes);
  return fmt::format("by mortar: {}; force, moment and work are kept to {:.0e}", in_words(fit, units), most);
}

}  // namespace tether::protocol
