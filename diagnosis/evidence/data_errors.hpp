#pragma once

#include "common/config/diagnosis_case.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tether {

/// What data may err in, none of it physics: displaced as a whole or in one frame, along the normal as by a wrong
/// threshold, shown at another time than said. To first order these follow from the base run alone (D.7). They become
/// candidates, and as far as `allowed` says errors that are no news. `unit_of_length`, `unit_of_time`: symbols.
void add_data_errors(EffectProblem& problem, const Evidence& evidence, const FinishedMotion& base,
                     const AllowanceCase& allowed, const std::string& unit_of_length, const std::string& unit_of_time);

/// "ct, 0.26 s".
std::string frame_text(const Evidence& evidence, const Evidence::Part& part);

/// Each region at each moment (all along the vessel, one end against the other, the ends against the middle), and over
/// the beat (constant, cosine, sine): what may be off without any effect's doing (D.11). As errors of the model's mesh
/// they are allowed.
void add_patterns(EffectProblem& problem, const Evidence& evidence, const AllowanceCase& allowed, double start,
                  double end);

/// Appends columns to a matrix of the problem.
void append_columns(MatrixXd& to, const MatrixXd& columns);
/// Appends an error that is allowed with a deviation, if that is above zero. name: empty if nobody can look after it.
void allow(EffectProblem& problem, const VectorXd& column, double deviation, const std::string& name);

}  // namespace tether
