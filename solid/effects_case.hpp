#pragma once

#include "common/config/case_file.hpp"
#include "solid/local_effect.hpp"
#include "solid/motion_case.hpp"
#include "solid/surface_support.hpp"

namespace tether {

/// A number of an expression.
struct ExpressionParameterCase {
  double value = undefined;
  std::optional<double> absent, lower, upper, prior_deviation, scale;
  std::string transform = "linear", meaning;
  void declare(Fields& f);
};

/// A traction written as formulas.
struct ExpressionCase {
  std::string normal;
  std::vector<std::string> traction;
  Named<ExpressionParameterCase> parameters;
  void declare(Fields& f);
};

/// What is near a point.
struct BallCase {
  Vec3 point = Vec3::Constant(undefined);
  double within = undefined;
  void declare(Fields& f);
};

/// Where in its place an effect acts.
struct ExtentCase {
  double from = 0, to = 1;
  std::string toward;
  std::optional<BallCase> about;
  void declare(Fields& f);
  operator Extent() const;
};

/// An effect on a part of the wall, under a name of the user's choice: `solid.effects.NAME`. A case has any number of
/// them, also several on one region; at their absent values they change nothing.
struct WallEffectCase {
  EffectCase effect;
  std::string region;  ///< of the outer wall, or a ring; empty: the whole outer wall
  ExtentCase extent;
  std::optional<MotionCase> motion;
  ExpressionCase expression;
  void declare(Fields& f);
};

/// Throws InputError "file:line: ..." for a region or ring that the wall does not have, and for an effect that cannot
/// act there.
void check_effects(const Named<WallEffectCase>& effects, const WallMesh& mesh, const CaseFile& file);

/// Whether an effect stands in place of this ring's clamp.
bool is_loose(const std::string& ring, const Named<WallEffectCase>& effects);

/// Appends what acts on the wall's surface, and ties what holds it, these, the supports already there and rings whose
/// motion is `given`, to the tissue that moves.
void add_surface_effects(const Named<WallEffectCase>& effects, const WallMesh& mesh, const CaseFile& file,
                         std::vector<SurfaceSupport>& supports, std::vector<DrivenRing>& given);

/// In what parts of the wall differ.
std::vector<LocalEffect> local_effects(const Named<WallEffectCase>& effects, const WallMesh& mesh);

}  // namespace tether
