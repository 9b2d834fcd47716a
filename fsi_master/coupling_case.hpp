#pragma once

#include "common/config/fields.hpp"

namespace tether {

/// The section `coupling` of a case: how fluid and wall are brought to agree, and who they are.
struct CouplingCase {
  struct Programs {
    std::string fluid = "fluid", solid = "solid", observation = "observation_manager";
    void declare(Fields& f);
  };
  /// Processes of codes that run in several.
  struct Ranks {
    int fluid = 1, solid = 1;
    void declare(Fields& f);
  };
  std::string method = "automatic", mapping = "automatic", processes = "apart";
  double tolerance = 1e-6;
  int max_iterations = 30, reuse = 20, halvings = 3;
  std::optional<double> mapping_distance;
  Programs programs;
  Ranks ranks;
  void declare(Fields& f);
};

}  // namespace tether
