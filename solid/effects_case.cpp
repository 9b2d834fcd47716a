#include "solid/effects_case.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "common/base/error.hpp"
#include "common/base/shortened.hpp"
#include "common/base/transform.hpp"
#include "common/mesh/triangle_locator.hpp"
#include "solid/motions/registry.hpp"
#include "solid/supports/expression_traction.hpp"
#include "solid/supports/registry.hpp"
#include "solid/vessel_direction.hpp"
#include "solid/wall_effects/registry.hpp"
#include "vessel/regions.hpp"

namespace tether {
namespace {

const EffectDeclaration expression_declaration{
    .name = "expression",
    .meaning = "A traction on the outer wall, written as formulas in the case file",
    .place = Place::outer_wall,
    .parameters = {},
    .role = EffectRole::loads};

const std::vector<const EffectDeclaration*>& family() {
  static const std::vector<const EffectDeclaration*> all = [] {
    std::vector<const EffectDeclaration*> list = declarations(surface_effects());
    for (const EffectDeclaration* more : declarations(motions())) list.push_back(more);
    for (const EffectDeclaration* more : declarations(wall_effects())) list.push_back(more);
    list.push_back(&expression_declaration);
    return list;
  }();
  return all;
}

template <class Physics>
bool is_of(std::span<const Registered<Physics>> registry, const std::string& type) {
  return std::any_of(registry.begin(), registry.end(),
                     [&](const auto& entry) { return entry.declaration.name == type; });
}

const Patch* find_patch(const std::vector<Patch>& patches, const std::string& name) {
  const auto found = std::find_if(patches.begin(), patches.end(), [&](const Patch& p) { return p.name == name; });
  return found == patches.end() ? nullptr : &*found;
}

/// A region, a ring, or the whole outer wall.
Patch patch_of(const std::string& region, const WallMesh& mesh) {
  for (const auto* patches : {&mesh.outside, &mesh.rings})
    if (const Patch* patch = find_patch(*patches, region)) return *patch;
  Patch all;
  for (const Patch& patch : mesh.outside)
    all.triangles.insert(all.triangles.end(), patch.triangles.begin(), patch.triangles.end());
  return all;
}

std::string parts_of(const WallMesh& mesh) {
  std::string known;
  for (const auto* patches : {&mesh.outside, &mesh.rings})
    for (const Patch& patch : *patches) known += (known.empty() ? "" : ", ") + patch.name;
  return known;
}

/// Whether a support is on one of these triangles.
bool shares(const SurfaceSupport& support, const std::vector<Triangle>& triangles) {
  const auto& own = support.triangles();
  return std::any_of(own.begin(), own.end(), [&](const Triangle& t) {
    return std::find(triangles.begin(), triangles.end(), t) != triangles.end();
  });
}

bool holds(const SurfaceSupport& support) {
  return support.effect().declaration().role != EffectRole::loads;
}

/// Of a type that the case's reader has let pass.
const EffectDeclaration& declaration_of(const std::string& type) {
  return **std::find_if(family().begin(), family().end(), [&](const auto* effect) { return effect->name == type; });
}

/// Ties what holds the wall at a patch to moving tissue. A support that holds more of the wall is tied as a whole.
void tie(const std::shared_ptr<MovingTissue>& tissue, const Patch& patch, std::vector<SurfaceSupport>& supports,
         std::vector<DrivenRing>& given) {
  bool tied = false;
  for (DrivenRing& ring : given) {
    if (ring.name != patch.name) continue;
    ring.anchor.tissues.push_back(tissue);
    tied = true;
  }
  for (SurfaceSupport& support : supports) {
    if (!holds(support) || !shares(support, patch.triangles)) continue;
    support.follow(tissue);
    tied = true;
  }
  if (!tied)
    throw input_error("{}: nothing holds the wall there: what moves must be tied to it by a support", tissue->path);
}

Parameter parameter_of(const std::string& name, const ExpressionParameterCase& given) {
  return {.name = name,
          .meaning = given.meaning,
          .dimension = dimension::none,
          .range = {given.lower.value_or(-infinite), given.upper.value_or(infinite)},
          .standard = given.value,
          .absent = given.absent.value_or(undefined),
          .transform = transform_named(given.transform),
          .prior_deviation = given.prior_deviation.value_or(undefined),
          .scale = given.scale.value_or(undefined)};
}

/// The expression's effect. Throws InputError that begins with `where`.
Configured<Support> configured(const ExpressionCase& given, const WallMesh& mesh, const std::string& where) {
  const Vec3 size = mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff();
  ExpressionLaw law{given.normal, given.traction, {}, size.norm()};
  std::vector<double> values;
  for (const auto& [name, parameter] : given.parameters) {
    law.parameters.push_back(parameter_of(name, parameter));
    values.push_back(parameter.value);
  }
  try {
    return configure(law, std::move(values));
  } catch (const InputError& error) {
    throw input_error("{}: {}", where, error.what());
  }
}

/// Throws InputError that begins with `where`.
void check_neighbour(const WallEffectCase& block, const Neighbours& all, const std::string& where) {
  const std::string& toward = block.extent.toward;
  if (block.region.empty()) throw input_error("{}: needs 'region': the whole outer wall has no neighbours", where);
  const auto known = all.find(block.region);
  const std::vector<std::string> neighbours = known == all.end() ? std::vector<std::string>() : known->second;
  if (std::find(neighbours.begin(), neighbours.end(), toward) == neighbours.end())
    throw input_error(
        "{}: {}: is not beside {}; there {}", where, toward, block.region,
        neighbours.empty() ? "is no other region" : "are " + fmt::format("{}", fmt::join(neighbours, ", ")));
  if (neighbours.size() < 2)
    throw input_error("{}: {}: all of {} is nearest to it, its only neighbour", where, toward, block.region);
}

double distance_to(const Vec3& point, const Patch& patch, const Points& points) {
  return TriangleLocator(points, patch.triangles).nearest(point).distance;
}

/// Where effects act on a wall; what it takes to tell is computed when it is first asked for.
class PlacesOfEffects {
 public:
  explicit PlacesOfEffects(const WallMesh& mesh) : mesh_(mesh) {}

  /// Of a region, a ring, or the whole outer wall, what the effect acts on.
  Patch of(const WallEffectCase& block) {
    Patch patch = patch_of(block.region, mesh_);
    const Extent extent = block.extent;
    if (!extent.is_all_along()) patch = part_between(patch, along(), extent.from, extent.to);
    if (!extent.toward.empty()) patch = part_between(patch, near(extent.toward, block.region), 0, 1);
    if (const auto& ball = extent.about)
      patch = divided_by_distance(patch, mesh_.points, ball->centre, ball->radius).near;
    return patch;
  }

 private:
  const VectorXd& along() { return along_.size() > 0 ? along_ : along_ = place_along_vessel(mesh_); }
  const VectorXd& near(const std::string& neighbour, const std::string& region) {
    VectorXd& known = near_[{neighbour, region}];
    return known.size() > 0 ? known : known = nearness(neighbour, region, mesh_.outside, mesh_.points);
  }

  const WallMesh& mesh_;
  VectorXd along_;
  std::map<std::pair<std::string, std::string>, VectorXd> near_;
};

}  // namespace

void ExpressionParameterCase::declare(Fields& f) {
  f.number("value", value, dimension::none, range::any, "in the case's units");
  f.number("absent", absent, dimension::none, range::any,
           "value at which the expression does nothing, if there is one");
  f.number("lower", lower, dimension::none, range::any, "least admissible value");
  f.number("upper", upper, dimension::none, range::any, "largest admissible value");
  f.choice("transform", transform,
           {{"linear", "itself"},
            {"log", "natural logarithm"},
            {"log2", "logarithm to base 2"},
            {"bounded", "between lower and upper"}},
           "how it is stretched when it is identified");
  f.number("prior_deviation", prior_deviation, dimension::none, range::positive,
           "standard deviation after the transform");
  f.number("scale", scale, dimension::none, range::positive, "how far from 'absent' the value of a patient may be");
  f.text("meaning", meaning, "for reports");
}

void ExpressionCase::declare(Fields& f) {
  f.text("normal", normal,
         "traction along the outward normal, a formula of the imaged position x y z, the normal nx ny nz, displacement "
         "ux uy uz, "
         "velocity vx vy vz, their parts along the normal un vn, the time t, and the parameters");
  f.texts("traction", traction,
          "x, y and z components of the traction, such formulas; beside 'normal' or instead of it");
  f.check(!normal.empty() || !traction.empty(), "type", "needs 'normal', 'traction' or both");
  f.check(traction.empty() || traction.size() == 3, "traction", "must be three formulas");
  f.groups("parameters", parameters, "numbers that the formulas name: they can be identified like any other");
}

void BallCase::declare(Fields& f) {
  f.point("point", point, dimension::length, "on the wall or near it");
  f.number("within", within, dimension::length, range::positive, "distance from there, in space");
}

void ExtentCase::declare(Fields& f) {
  constexpr Range on_the_way{0, 1};
  f.number("from", from, dimension::none, on_the_way,
           "where along the vessel the region's part begins that it acts on: 0 at the first ring, 1 at the others");
  f.number("to", to, dimension::none, on_the_way, "where along the vessel that part ends");
  f.check(from < to, "to", "must be beyond 'from'");
  f.text("toward", toward,
         "a region beside this one: the effect acts on what is nearer to it than to the region's other neighbours");
  f.group("about", about, "the effect acts on what of its place is near a point, across regions where it has none");
}

ExtentCase::operator Extent() const {
  Extent extent{from, to, toward, std::nullopt};
  if (about) extent.about = Ball{about->point, about->within};
  return extent;
}

void WallEffectCase::declare(Fields& f) {
  f.effect(effect, family(), "what acts, or is different");
  f.text("region", region, "a region of the outer wall, or an end ring; absent: the whole outer wall");
  extent.declare(f);
  f.when("type", effect.type, {"measured_motion"}, [&] {
    f.group("motion", motion, "the motion over time");
    f.check(motion.has_value(), "type", "needs a section 'motion'");
  });
  f.when("type", effect.type, {"expression"}, [&] { expression.declare(f); });
}

void check_effects(const Named<WallEffectCase>& effects, const WallMesh& mesh, const CaseFile& file) {
  const Neighbours neighbours = neighbours_of(mesh.outside);
  PlacesOfEffects places(mesh);
  for (const auto& [name, block] : effects) {
    const std::string path = "solid.effects." + name;
    const bool on_ring = find_patch(mesh.rings, block.region) != nullptr;
    if (!block.region.empty() && !on_ring && find_patch(mesh.outside, block.region) == nullptr)
      throw input_error("{}: {}: the wall has no such part; it has: {}", file.where(path + ".region"),
                        shortened(block.region), parts_of(mesh));
    if (replaces_clamp(declaration_of(block.effect.type)) && !on_ring)
      throw input_error("{}: a {} needs the name of an end ring as its region", file.where(path), block.effect.type);
    if (is_of(wall_effects(), block.effect.type) && on_ring)
      throw input_error("{}: {} acts in regions of the outer wall, not in a ring", file.where(path), block.effect.type);
    if (!Extent(block.extent).is_all() && (on_ring || is_of(motions(), block.effect.type)))
      throw input_error("{}: 'from', 'to', 'toward' and 'about' are of what acts in regions of the outer wall",
                        file.where(path));
    if (!block.extent.toward.empty()) check_neighbour(block, neighbours, file.where(path + ".toward"));
    if (block.extent.about && places.of(block).parts.empty())
      throw input_error("{}: nothing of {} is within {:g} {} of it: the nearest place is {:.3g} {} away",
                        file.where(path + ".about"), block.region.empty() ? "the outer wall" : block.region,
                        block.extent.about->within, file.units().symbol(dimension::length),
                        distance_to(block.extent.about->point, patch_of(block.region, mesh), mesh.points),
                        file.units().symbol(dimension::length));
    if (block.effect.type == expression_declaration.name) configured(block.expression, mesh, file.where(path));
  }
}

bool is_loose(const std::string& ring, const Named<WallEffectCase>& effects) {
  return std::any_of(effects.begin(), effects.end(), [&](const auto& entry) {
    return entry.second.region == ring && replaces_clamp(declaration_of(entry.second.effect.type));
  });
}

void add_surface_effects(const Named<WallEffectCase>& effects, const WallMesh& mesh, const CaseFile& file,
                         std::vector<SurfaceSupport>& supports, std::vector<DrivenRing>& given) {
  PlacesOfEffects places(mesh);
  for (const auto& [name, block] : effects) {
    const std::string path = "solid.effects." + name;
    const auto add = [&, &name = name, &block = block](Configured<Support> effect) {
      Patch patch = places.of(block);
      patch.name = name;
      supports.emplace_back(std::move(patch), std::move(effect), TissueMotion{}, path);
    };
    if (is_of(surface_effects(), block.effect.type))
      add(Configured<Support>(surface_effects(), block.effect.type, block.effect.values));
    if (block.effect.type == expression_declaration.name) add(configured(block.expression, mesh, file.where(path)));
  }
  for (const auto& [name, block] : effects)
    if (is_of(motions(), block.effect.type)) {
      Configured<MotionLaw> motion(motions(), block.effect.type, block.effect.values);
      TissueMotion measured;
      if (block.motion) measured = block.motion->load(file.units(), patch_of(block.region, mesh), mesh.points);
      tie(std::make_shared<MovingTissue>(MovingTissue{"solid.effects." + name, std::move(motion), std::move(measured)}),
          patch_of(block.region, mesh), supports, given);
    }
}

std::vector<LocalEffect> local_effects(const Named<WallEffectCase>& effects, const WallMesh& mesh) {
  std::vector<LocalEffect> result;
  for (const auto& [name, block] : effects) {
    if (!is_of(wall_effects(), block.effect.type)) continue;
    std::vector<int> regions;
    for (std::size_t r = 0; r < mesh.outside.size(); ++r)
      if (block.region.empty() || mesh.outside[r].name == block.region) regions.push_back(static_cast<int>(r));
    result.push_back({"solid.effects." + name,
                      Configured<WallEffect>(wall_effects(), block.effect.type, block.effect.values),
                      std::move(regions), block.extent});
  }
  return result;
}

}  // namespace tether
