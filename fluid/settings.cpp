#include "fluid/settings.hpp"

namespace tether::fluid {
namespace {

const EffectDeclaration blood_declaration{
    "blood",
    "the blood, and how its equations are stabilised and handed to the wall",
    Place::blood,
    {{"density", "mass of the blood per volume", dimension::density, range::positive, undefined, undefined,
      Transform::log, 0.02},
     {"backflow_stabilisation",
      "factor beta of the force that damps blood entering through an outlet; 0.5 removes all its energy",
      dimension::none,
      {0, 1},
      0.2,
      0.0,
      Transform::linear,
      undefined},
     {"wall_load_offset",
      "pressure added to the load on the wall: the reference pressure, if the imaged wall carries it",
      dimension::pressure, range::any, 0.0, 0.0, Transform::linear, undefined}}};

}  // namespace

std::span<const Registered<Blood>> blood() {
  static const Registered<Blood> table[] = {
      {blood_declaration, [](std::span<const double> v) -> std::unique_ptr<Blood> {
         return std::make_unique<Blood>(Blood{v[0], v[1], v[2]});
       }}};
  return table;
}

}  // namespace tether::fluid
