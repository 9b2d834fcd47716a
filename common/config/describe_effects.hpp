#pragma once

#include "common/config/describe.hpp"

namespace tether {

/// Collects the families of effects that sections offer: the page of all effects, each once, with where it can stand
/// and what there is to say of its numbers.
class DescribeEffects : public Describe {
 public:
  explicit DescribeEffects(const UnitSystem& units) : Describe(units), units_(units) {}

  std::string markdown() const;

 protected:
  void offers(EffectFamily family) override;

 private:
  struct Offer {
    const EffectDeclaration* effect;
    std::vector<std::string> sections;
  };
  std::string table_of(const EffectDeclaration& effect) const;
  std::string row_of(const Parameter& p) const;

  UnitSystem units_;
  std::vector<Offer> offers_;
};

}  // namespace tether
