#pragma once

#include <optional>

#include "diagnosis/noise/restricted_likelihood.hpp"

namespace tether {

/// How probable deviations, lengths and nuggets of one shape are: the restricted likelihood on a lattice of lengths and
/// nuggets that is fine where it is large; the deviation's part is known in closed form. Beforehand the logarithms of
/// deviation and length, and the nugget's root, have any value alike. (D.23)
class NoisePosterior {
 public:
  NoisePosterior(const RestrictedLikelihood& likelihood, CorrelationShape shape);

  /// Medians and 95 % intervals.
  NoiseFit fit() const;
  /// Whether the interval of the length ends where the places do.
  bool reaches_end() const;
  /// The largest.
  double log_likelihood() const;
  /// The largest with this deviation and length, or with one of them whatever the other; whatever the nugget.
  double log_likelihood_with(std::optional<double> deviation, std::optional<double> length) const;

 private:
  struct Node {
    double log_length, nugget;
    RestrictedSums sums;
    double log_likelihood, weight;
  };
  double add_slice(double log_length);
  void weigh(const std::vector<double>& log_lengths);
  MeasuredNumber length() const;
  MeasuredNumber nugget() const;
  MeasuredNumber deviation() const;

  const RestrictedLikelihood& likelihood_;
  CorrelationShape shape_;
  double longest_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace tether
