#include "solid/anchor.hpp"

#include <algorithm>

namespace tether {

AffineDisplacement Anchor::at(double time) const {
  AffineDisplacement rest = motion ? motion(time) : AffineDisplacement{};
  for (const auto& tissue : tissues)
    if (!tissue->motion.is_absent()) rest += tissue->motion->at(time, tissue->measured);
  return rest;
}

bool Anchor::moves() const {
  return motion ||
         std::any_of(tissues.begin(), tissues.end(), [](const auto& tissue) { return !tissue->motion.is_absent(); });
}

}  // namespace tether
