#pragma once

#include <string>

#include "vessel/vessel_files.hpp"

namespace tether {

/// The files of data/peer_tube: axis z from 0 to 10, lumen radius 2, wall 0.2 in two layers of tetrahedra.
inline VesselFiles peer_tube_files() {
  const std::string folder = "data/peer_tube/";
  const auto fluid = [&](const std::string& face) { return FaceSource{folder + "fluid/faces/" + face + ".vtp", {}}; };
  const auto solid = [&](const std::string& face) { return FaceSource{folder + "solid/faces/" + face + ".vtp", {}}; };
  VesselFiles files;
  files.fluid = folder + "fluid/mesh.vtu";
  files.wall = folder + "solid/mesh.vtu";
  files.interface = fluid("interface");
  files.wall_interface = solid("interface");
  files.inlets = {{"inlet", fluid("inlet")}};
  files.outlets = {{"outlet", fluid("outlet")}};
  for (const char* name : {"spine", "vicinity_a", "vicinity_b", "opposite"})
    files.outside.emplace_back(name, solid(std::string("outside_") + name));
  files.rings = {{"inlet_ring", solid("inlet")}, {"outlet_ring", solid("outlet")}};
  return files;
}

}  // namespace tether
