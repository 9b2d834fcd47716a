#pragma once

#include "diagnosis/evidence/model_runs.hpp"
#include "diagnosis/results/published.hpp"
#include "diagnosis/search/diagnosis_report.hpp"
#include "diagnosis/search/trials.hpp"

namespace tether {

/// Quantities of the model as it is, with all that was accepted, and with each rival in the place of one of these, the
/// others as they were found. Makes runs of rivals beside what was accepted after the one in whose place they are; the
/// others are there. base: the run of the model as it is. Empty where nothing was accepted that changes the model.
std::vector<PublishedQuantities> published_models(const DiagnosedCase& given, const Evidence& evidence,
                                                  const DiagnosisReport& report, Trials& trials,
                                                  const FinishedMotion& base, const ModelRuns& runs);

}  // namespace tether
