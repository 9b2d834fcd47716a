#include "batch/job_results.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Heading and cell.
using Row = std::vector<std::pair<std::string, std::string>>;

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

Row row_of(const RunSummary& run) {
  Row row{{"steps", std::to_string(run.steps)}};
  if (run.pressure) {
    const double image = run.pressure->relative_to_mmhg;
    row.emplace_back("lowest pressure [mmHg]", number(image + run.pressure->min_mmhg));
    row.emplace_back("highest pressure [mmHg]", number(image + run.pressure->max_mmhg));
  }
  row.emplace_back("largest displacement [mm]", number(run.max_displacement_mm));
  row.emplace_back("seconds a step [s]", number(run.seconds_per_step));
  return row;
}

void add_distance(Row& row, const SourceCompared& source, const char* which, const FramesJudged& frames) {
  for (const GroupTold& group : frames.all_frames)
    if (!group.series && !group.region && group.in_noise)
      row.emplace_back(fmt::format("{}, {} frames [noise]", source.name, which), number(group.in_noise->rms));
}

Row row_of(const ComparisonResult& comparison) {
  Row row;
  for (const SourceCompared& source : comparison.sources) {
    add_distance(row, source, "training", source.training);
    add_distance(row, source, "held-out", source.held_out);
  }
  return row;
}

Row row_of(const Estimate& estimate) {
  Row row;
  for (const EstimatedParameter& p : estimate.parameters)
    for (const auto& [what, value] : {std::pair("", p.estimate.value), std::pair(", lower", p.estimate.lower),
                                      std::pair(", upper", p.estimate.upper)})
      row.emplace_back(fmt::format("{}{} [{}]", p.name, what, p.unit), number(value));
  return row;
}

Row row_of(const Diagnosis& diagnosis) {
  return {{"verdict", word_of(diagnosis.verdict)}, {"said", diagnosis.sentences.empty() ? "" : diagnosis.sentences[0]}};
}

Row row_of(const Explanation& explanation) {
  Row row{{"verdict", word_of(explanation.verdict)},
          {"said", explanation.sentences.empty() ? "" : explanation.sentences[0]}};
  const auto& models = explanation.models;
  const auto best = static_cast<std::size_t>(explanation.best);
  if (best < models.size() && models.front().held_out && models[best].held_out) {
    row.emplace_back("held-out frames, as given [noise]", number(models.front().held_out->in_noise));
    row.emplace_back("held-out frames, explained [noise]", number(models[best].held_out->in_noise));
  }
  return row;
}

template <class Record>
Row read(const fs::path& file) {
  if (std::error_code none; fs::status(file, none).type() == fs::file_type::not_found) return {};
  try {
    return row_of(read_record<Record>(file));
  } catch (const InputError& error) {  // the others are told
    return {{"not read", error.what()}};
  }
}

Row row_of(JobVerb verb, const fs::path& results) {
  switch (verb) {
    case JobVerb::simulate:
      return read<RunSummary>(results / "summary.json");
    case JobVerb::compare:
      return read<ComparisonResult>(results / "comparison.json");
    case JobVerb::identify:
      return read<Estimate>(results / "estimate.json");
    case JobVerb::diagnose:
      return read<Diagnosis>(results / "diagnosis.json");
    case JobVerb::explain:
      return read<Explanation>(results / "explain.json");
  }
  return {};
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + csv_cell(cell);
  return line + "\n";
}

}  // namespace

std::string JobResults::csv() const {
  std::string text = csv_line(columns);
  for (const auto& row : cells) text += csv_line(row);
  return text;
}

std::string JobResults::text() const {
  std::string text;
  for (const auto& row : cells) {
    text += row.front() + "\n";
    for (std::size_t i = 1; i < row.size(); ++i)
      if (!row[i].empty()) text += fmt::format("  {:<40} {}\n", columns[i], row[i]);
  }
  return printable(text);
}

JobResults results_of(const Job& job, const fs::path& folder, const std::vector<CaseStatus>& states) {
  JobResults table{{"case", "state"}, {}};
  std::vector<Row> rows;
  for (std::size_t k = 0; k < job.cases.size(); ++k) {
    const bool is_done = states[k].state == CaseState::done;
    rows.push_back(is_done ? row_of(job.verb, folder / job.cases[k].name) : Row());
    for (const auto& [heading, cell] : rows.back())
      if (std::find(table.columns.begin(), table.columns.end(), heading) == table.columns.end())
        table.columns.push_back(heading);
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<std::string> cells(table.columns.size());
    cells[0] = job.cases[k].name;
    cells[1] = word_of(states[k].state);
    for (const auto& [heading, cell] : rows[k])
      cells[static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), heading) -
                                     table.columns.begin())] = cell;
    table.cells.push_back(std::move(cells));
  }
  return table;
}

}  // namespace tether
