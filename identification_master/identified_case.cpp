#include "identification_master/identified_case.hpp"

#include "common/config/overlay.hpp"

namespace tether {

void write_identified_case(const std::filesystem::path& path, const CaseFile& from,
                           const IdentifiedParameters& parameters, const VectorXd& theta) {
  const NamedValues found = parameters.values_at(theta);
  Overlay overlay{
      from.path(), from.common().name + "_identified", from.common().titled(", with identified parameters"), {}};
  for (std::size_t i = 0; i < found.names.size(); ++i)
    overlay.values.push_back({found.names[i], number_text(found.values[i])});
  write_overlay(path, overlay);
}

}  // namespace tether
