#pragma once

#include "common/base/units.hpp"
#include "diagnosis/comparison/discrepancy.hpp"

namespace tether {

/// Consecutive moments of one region in which the model is farther from the data than noise explains.
struct Failure {
  int region = -1;
  double first = 0, last = 0, worst = 0;  ///< the first and last moment, and that of the largest distance [time]
  bool shifted = false;                   ///< the mean signed distance is beyond noise; else the mean square only
  double mean = 0, rms = 0;               ///< at the worst moment [length]
  double z = 0;                           ///< significance of that mean (D.3)
  double size() const;                    ///< the distance that counts [length]
};

/// Whether a source, on its training or its held-out frames, is within noise of the run.
struct Judgement {
  int tests = 0;                  ///< regions x moments that were looked at; 0: no noise is stated, or no frames
  double limit = 0;               ///< of |z|, so that of 20 right models 19 pass in all tests (D.4)
  std::vector<Failure> failures;  ///< in the order of their first moments
  std::vector<std::pair<int, double>> visible;  ///< region, and the offset of it that one frame would show (D.5)
};
Judgement judge(const SourceDiscrepancy& source, bool held_out);

/// The earliest failure (of several the largest), and the largest; null if there is none.
const Failure* first_of(const Judgement& verdict);
const Failure* worst_of(const Judgement& verdict);

/// "spine, 0.18-0.36 s: the model lies 1.4 mm too far outward (6.2 sigma)"
std::string sentence_of(const Failure& failure, const SourceDiscrepancy& source, const UnitSystem& units);

/// What the verdict tells a person, one sentence each: where the model fails worst, first, and in other regions; or
/// that it does not, and how large an offset would have been seen; or, without a noise, only where it is farthest off.
std::vector<std::string> sentences_of(const Judgement& verdict, const SourceDiscrepancy& source, bool held_out,
                                      const UnitSystem& units);

}  // namespace tether
