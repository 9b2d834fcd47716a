#pragma once

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/search/held_out_gain.hpp"

namespace tether {

/// How far the data on the lumen among these rows are from a run; nothing if there are none.
std::optional<Misfit> misfit_of(const EffectProblem& problem, const Evidence& evidence, const VectorXd& residual,
                                const std::vector<Eigen::Index>& rows);

/// The gain on held-out data between two runs; nothing if hardly any are held out.
std::optional<Gain> gain_between(const EffectProblem& problem, const VectorXd& before, const VectorXd& after);

/// One frame of a source, by the section of the case and its number.
using FrameOfSource = std::pair<std::string, double>;

/// A sentence for each frame, held out or not, that lies off a model much farther than most, and beyond noise; not for
/// those that are known to be wrong.
std::vector<std::string> odd_frames(const Evidence& evidence, const EffectProblem& problem, const VectorXd& residual,
                                    const std::vector<FrameOfSource>& known);

}  // namespace tether
