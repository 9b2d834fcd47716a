#pragma once

#include "common/base/units.hpp"
#include "diagnosis/evidence/diagnosis_case.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tether {

/// What data may err in, none of it physics: every fault of the registry that concerns them, of a source as a whole and
/// of single frames. To first order these follow from the base run alone (D.7). They become candidates, and as far as
/// `allowed` says errors that are no news. asked: names of those that are looked for on request only.
void add_data_errors(EffectProblem& problem, const Evidence& evidence, const FinishedMotion& base,
                     const AllowanceCase& allowed, const UnitSystem& units, const std::vector<std::string>& asked = {});

/// Names of faults that these data can have, and that are looked for on request only, without those asked for.
std::vector<std::string> faults_not_asked(const Evidence& evidence, const std::vector<std::string>& asked);

/// "ct, 0.26 s".
std::string frame_text(const Evidence& evidence, const Evidence::Part& part);

/// Appends columns to a matrix of the problem.
void append_columns(MatrixXd& to, const MatrixXd& columns);
/// Appends an error that is allowed with a deviation, if that is above zero. name: empty if nobody can look after it.
void allow(EffectProblem& problem, const VectorXd& column, double deviation, const AllowedError& error = {});

}  // namespace tether
