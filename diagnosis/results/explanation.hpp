#pragma once

#include "diagnosis/results/diagnosis.hpp"

namespace tether {

/// How far measured lumens are from a run, in root mean square.
struct Misfit {
  static constexpr const char* type_name = "misfit";
  double length = 0, in_noise = 0;

  static void fields(auto& self, auto&& field) {
    field("l2", self.length, "root mean square distance [length]");
    field("in_noise", self.in_noise, "in the noise's deviation, of independent data");
  }
};

/// A model of the path: the case as given, or the one before it with what a diagnosis added.
struct ExplainedModel {
  static constexpr const char* type_name = "explained_model";
  int number = 0;
  std::string name, case_file, run;
  std::optional<std::string> diagnosis, identification;
  std::vector<Finding> added;
  bool accepted = true;
  std::optional<Objection> objection;
  std::string reason;
  std::optional<Misfit> training, held_out;
  std::optional<Gain> gain;

  static void fields(auto& self, auto&& field) {
    field("number", self.number, "0: as given");
    field("name", self.name, "what was added to the model before it");
    field("case", self.case_file, "in the output folder");
    field("run", self.run, "folder of its run without correction, with comparison.json");
    field("diagnosis", self.diagnosis, "folder of the diagnosis of what it lacks");
    field("identification", self.identification, "folder of the identification of its parameters");
    field("added", self.added, "with identified amplitudes");
    field("accepted", self.accepted, "better than the model before it");
    field("objection", self.objection, "why not");
    field("reason", self.reason, "the same in words");
    field("training", self.training, "distance of the lumen on training frames; null: none shows it");
    field("held_out", self.held_out, "the same on held-out frames");
    field("held_out_gain", self.gain, "on held-out data, against the model before it");
  }
};

struct ExplanationCost {
  static constexpr const char* type_name = "explanation_cost";
  double cpu_seconds = 0, wall_seconds = 0;

  static void fields(auto& self, auto&& field) {
    field("cpu_seconds", self.cpu_seconds, "of all steps [s]");
    field("wall_seconds", self.wall_seconds, "of all steps [s]");
  }
};

/// What a step took.
struct ExplainedStep {
  static constexpr const char* type_name = "explained_step";
  std::string name, folder;
  double wall_seconds = 0, cpu_seconds = 0;
  std::string key;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "what was done");
    field("folder", self.folder, "of its results");
    field("wall_seconds", self.wall_seconds, "[s]");
    field("cpu_seconds", self.cpu_seconds, "[s]");
    field("key", self.key, "of all that it depends on: a step with the same key need not be made again");
  }
};

/// A file of a step's folder, as the step left it.
struct LeftFile {
  static constexpr const char* type_name = "left_file";
  std::string name, content;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "in the step's folder");
    field("content", self.content, "a hash of what it holds");
  }
};

/// A step, and its results.
struct StepMade {
  static constexpr const char* type_name = "step_made";
  ExplainedStep step;
  std::vector<LeftFile> left;

  static void fields(auto& self, auto&& field) {
    field("step", self.step, "what was made");
    field("left", self.left, "its records and tables: one that is not as it was left is made again");
  }
};

/// The steps that were made so far: steps.json.
struct StepsMade {
  static constexpr const char* type_name = "steps_made";
  std::vector<StepMade> steps;

  static void fields(auto& self, auto&& field) { field("steps", self.steps, "in their order"); }
};

/// The path from a model to one that explains its measurements: explain.json (docs/explain.md).
struct Explanation {
  static constexpr const char* type_name = "explanation";
  std::string case_name, title, case_file;
  std::vector<std::string> data;
  Verdict verdict = Verdict::undecided;
  Statement statement;
  std::vector<std::string> sentences;
  std::vector<ExplainedModel> models;
  int best = 0;
  std::vector<Finding> effects;
  std::vector<Detectable> detectable;
  std::optional<Gain> held_out;
  std::optional<std::string> missing_force, suggested_case, corrected_case;
  ExplanationCost cost;
  std::vector<ExplainedStep> steps;

  static void fields(auto& self, auto&& field) {
    field("case", self.case_name, "name of the case");
    field("title", self.title, "of the case");
    field("case_file", self.case_file, "relative to the output folder");
    field("data", self.data, "hashes of what the files of the measurements held");
    field("verdict", self.verdict, "of the whole path");
    field("statement", self.statement, "what was found, of which the first sentence is made");
    field("sentences", self.sentences, "the verdict first, then what a person should know next");
    field("models", self.models, "from the one as given on");
    field("best", self.best, "number of the last model that was accepted");
    field("effects", self.effects, "what was found first, with identified amplitudes, then the others by evidence");
    field("detectable", self.detectable, "of the last diagnosis");
    field("held_out", self.held_out, "gain of the best model against the one as given, on held-out data");
    field("missing_force", self.missing_force, "file of a force that no candidate explains");
    field("suggested_case", self.suggested_case, "file: the case with what was found");
    field("corrected_case", self.corrected_case, "file: the case with its data corrected");
    field("cost", self.cost, "of all steps");
    field("steps", self.steps, "in their order");
  }
};

}  // namespace tether
