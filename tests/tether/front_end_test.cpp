// The front-end beside a fsi_master that is a shell script: what reaches it, what comes back, what a person reads.
#include "tests/tether/front_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace tether {
namespace front_end_test {

TEST_F(FrontEnd, SimulatesDrawsAndSaysWhereToLook) {
  const ChildEnd end = tether("simulate case.yaml --output results");
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(end.output, R"(tube: A tube
2 steps of 0.1 s, results in results
  2 steps in 1.2 s, 2.0 of CPU: 0.625 and 1.000 s a step; memory 100 MB over all processes
  pressure       0.8 .. 1.5 mmHg
  displacement   at most 2 mm
  coupling       2.50 evaluations a step, at most 3 (iqn_ils)
  periodic       since beat 2: beat 2 differs from the one before by at most 0.4 % in pressure, 0.12 % in volume
  mass balance   off by at most 1.0e-13 cm3/s
In results:
  plots/             pressures.png, flows.png, displacements.png, coupling.png
  timeseries.csv     pressures, flows, displacements, forces at every step
  summary.json       what was run, and how it went
)");
  for (const char* picture : {"pressures.png", "flows.png", "displacements.png", "coupling.png"})
    EXPECT_GT(fs::file_size(folder_ / "results/plots" / picture), 5000u) << picture;
}

TEST_F(FrontEnd, HandsTheOptionsOn) {
  EXPECT_EQ(tether("simulate case.yaml --output results --steps 7 --resume --quiet").output, "");
  EXPECT_EQ(content("arguments"), "case.yaml --output results --steps 7 --resume --quiet\n");
}

TEST_F(FrontEnd, TellsItsVersion) {
  const ChildEnd end = tether("--version");
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_TRUE(std::regex_match(end.output, std::regex("tether \\d+\\.\\d+\\.\\d+( \\(.+\\))?\n"))) << end.output;
}

TEST_F(FrontEnd, DoesNotStartAWrongCase) {
  program("fsi_master",
          "case \"$*\" in *--validate*) echo 'case.yaml:3: units: cgi' >&2; exit 2;; esac; touch started");
  for (const char* verb : {"simulate", "validate"}) {
    const ChildEnd end = tether(std::string(verb) + " case.yaml");
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_EQ(end.errors, "case.yaml:3: units: cgi\n");
  }
  EXPECT_FALSE(fs::exists(folder_ / "started"));
  EXPECT_EQ(tether("simulate none.yaml").errors, "none.yaml: no such file\n");
}

TEST_F(FrontEnd, ShowsProgramsOfACaseInOneLineThatNoTerminalObeys) {
  std::ofstream(folder_ / "case.yaml", std::ios::app) << "coupling: {programs: {solid: \"./a\\e[2K\\rb\\nc\"}}\n";
  EXPECT_EQ(tether("validate case.yaml").errors, "case.yaml:5: this case runs ./a?[2K?b?c as its solid\n");
}

TEST_F(FrontEnd, ValidatesTheMeasurementsToo) {
  program("observation_manager", "echo 'ct.stl: holds no triangles' >&2; exit 2");
  const ChildEnd end = tether("validate case.yaml");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.errors, "ct.stl: holds no triangles\n");
  EXPECT_EQ(tether("simulate case.yaml --output results").exit_code, 0) << "a simulation needs no measurement";
}

TEST_F(FrontEnd, ReturnsTheCodeOfARunThatFails) {
  program("fsi_master",
          "case \"$*\" in *--validate*) exit 0;; esac; echo 'fsi_master: step 3 does not converge' >&2; touch "
          "$TETHER_TOLD; exit 1");
  const ChildEnd end = tether("simulate case.yaml --quiet");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_EQ(end.errors, "fsi_master: step 3 does not converge\n") << "one message, none of mpirun's own";
}

TEST_F(FrontEnd, CallsAKilledRunFailed) {
  program("fsi_master", "case \"$*\" in *--validate*) exit 0;; esac; kill -KILL $$");
  const ChildEnd end = tether("simulate case.yaml --quiet");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("tether: fsi_master or a process that it started was ended by signal 9"), std::string::npos)
      << end.errors;
}

/// With some values it does not begin, and says nothing.
TEST_F(FrontEnd, NamesWhatTheEnvironmentSetsOfOpenMpi) {
  program("fsi_master", "case \"$*\" in *--validate*) exit 0;; esac; exit 1");
  const ChildEnd end = capture({{"/bin/sh", "-c", "cd " + folder_.string() + " && ./tether simulate case.yaml --quiet"},
                                {{"OMPI_MCA_mpi_param_check", "1"}}});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("without a word: was mpirun interrupted?; the environment sets "), std::string::npos);
  EXPECT_NE(end.errors.find("OMPI_MCA_mpi_param_check"), std::string::npos) << end.errors;
}

TEST_F(FrontEnd, NamesALimitThatIsNoNumber) {
  EXPECT_EQ(tether("simulate case.yaml --output results --quiet").exit_code, 0);
  const ChildEnd wrong = capture({{"/bin/sh", "-c", "cd " + folder_.string() + " && ./tether simulate case.yaml"},
                                  {{"TETHER_STOPPED_LIMIT", "5 min"}}});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.errors, "TETHER_STOPPED_LIMIT: '5 min' is not a number of seconds above zero\n");
}

TEST_F(FrontEnd, AddsHowToGoOnToWhatTheRunSaid) {
  program(
      "fsi_master",
      "case \"$*\" in *--validate*) exit 0;; esac; mkdir -p results/checkpoint; touch results/checkpoint/master.bin; "
      "echo 'fsi_master: solid died' >&2; touch $TETHER_TOLD; kill -KILL $$");
  EXPECT_EQ(tether("simulate case.yaml --quiet --output results").errors,
            "fsi_master: solid died\nTo continue: tether simulate case.yaml --output results --resume\n");
}

/// The case says where results are; what failed is the run, all the same.
TEST_F(FrontEnd, TellsOfAFailureAlsoWhereTheCaseIsGoneMeanwhile) {
  program(
      "fsi_master",
      "case \"$*\" in *--validate*) exit 0;; esac; mkdir -p out/tube/checkpoint; touch out/tube/checkpoint/master.bin; "
      "rm case.yaml; echo 'fsi_master: solid died' >&2; touch $TETHER_TOLD; kill -KILL $$");
  const ChildEnd end = tether("simulate case.yaml --quiet");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_EQ(end.errors, "fsi_master: solid died\n");
}

/// A full disk, a step that does not converge: what was saved is there, and can be gone on from.
TEST_F(FrontEnd, AddsHowToGoOnToAnyFailureOfARunThatWasSaved) {
  program(
      "fsi_master",
      "case \"$*\" in *--validate*) exit 0;; esac; mkdir -p results/checkpoint; touch results/checkpoint/master.bin; "
      "echo 'fsi_master: lumen.motion: cannot be written' >&2; touch $TETHER_TOLD; exit 1");
  EXPECT_EQ(tether("simulate case.yaml --quiet --output results").errors,
            "fsi_master: lumen.motion: cannot be written\n"
            "To continue: tether simulate case.yaml --output results --resume\n");
}

/// Word for word what a shell takes, with all that decides what comes out.
TEST_F(FrontEnd, TheWayOnIsTheSameCommandWithItsOptions) {
  program("fsi_master",
          "case \"$*\" in *--validate*) exit 0;; esac; mkdir -p \"my out/checkpoint\"; "
          "touch \"my out/checkpoint/master.bin\"; touch $TETHER_TOLD; exit 1");
  EXPECT_EQ(tether("simulate case.yaml --steps 7 --output 'my out'").errors,
            "To continue: tether simulate case.yaml --output 'my out' --steps 7 --resume\n");
}

/// A checkpoint of an identification in the same folder is none of a run.
TEST_F(FrontEnd, TellsNoWayOnFromWhatAnotherVerbSaved) {
  program("fsi_master",
          "case \"$*\" in *--validate*) exit 0;; esac; mkdir -p results/checkpoint; "
          "touch results/checkpoint/identification.bin; touch $TETHER_TOLD; exit 1");
  EXPECT_EQ(tether("simulate case.yaml --quiet --output results").errors, "");
}

TEST_F(FrontEnd, ValidatesAnIdentificationToo) {
  program("identification_master", "echo 'case.yaml:5: identification.observe: sometimes' >&2; exit 2");
  EXPECT_EQ(tether("validate case.yaml").exit_code, 0) << "the case identifies nothing";
  std::ofstream(folder_ / "case.yaml", std::ios::app) << "identification: {observe: sometimes}\n";
  for (const char* verb : {"validate", "identify", "identify --validate"}) {
    const ChildEnd end = tether(std::string(verb) + " case.yaml");
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_EQ(end.errors, "case.yaml:5: identification.observe: sometimes\n") << verb;
  }
}

TEST_F(FrontEnd, ValidatesWhatAVerbWants) {
  EXPECT_EQ(tether("simulate --validate case.yaml").exit_code, 0);
  for (const auto& [verb, wanted] : {std::pair("compare", "observations: names nothing that was measured"),
                                     {"diagnose", "mesh.swept.wall_thickness: missing"},
                                     {"explain", "mesh.swept.wall_thickness: missing"}}) {
    const ChildEnd end = tether(std::string(verb) + " --validate case.yaml");
    EXPECT_EQ(end.exit_code, 2) << verb;
    EXPECT_NE(end.errors.find(wanted), std::string::npos) << end.errors;
  }
}

/// To be simulated, and only later identified.
TEST_F(FrontEnd, AsksOfACaseOnlyWhatTheVerbReads) {
  std::ofstream(folder_ / "case.yaml", std::ios::app)
      << "identification: {observe: sometimes}\ntwin: {}\ndiagnosis: {candidates: 3}\n";
  for (const char* program_of_measurements : {"identification_master", "observation_manager"})
    program(program_of_measurements, "echo 'case.yaml:1: observations: names no measurements' >&2; exit 2");
  program("fsi_master", "for word; do [ \"$before\" = --output ] && output=$word; before=$word; done\n" +
                            std::regex_replace(finished_run, std::regex("results"), "$$output"));
  const ChildEnd plan = tether("simulate case.yaml --plan");
  EXPECT_EQ(plan.exit_code, 0) << plan.errors;
  const ChildEnd job = tether("submit simulate case.yaml --output job --time 20 --memory 1G --dry-run");
  EXPECT_EQ(job.exit_code, 0) << job.errors;
  for (const char* verb : {"compare", "identify", "diagnose", "explain"}) {
    const ChildEnd refused = tether(std::string(verb) + " case.yaml --plan");
    EXPECT_EQ(refused.exit_code, 2) << verb;
    EXPECT_EQ(refused.errors, "case.yaml:1: observations: names no measurements\n") << verb;
  }
}

TEST_F(FrontEnd, SubmitsIntoNoFolderOfOtherFiles) {
  const std::string submit = "submit simulate case.yaml --time 20 --memory 1G --dry-run --output ";
  std::ofstream(folder_ / "results.csv") << "mine";
  EXPECT_EQ(tether(submit + ".").exit_code, 2);
  EXPECT_EQ(content("results.csv"), "mine");
  std::ofstream(folder_ / "cases.csv") << "name, time.end [s]\na, 0.2\n";
  EXPECT_EQ(tether(submit + "made --table cases.csv").exit_code, 0);
  EXPECT_EQ(tether(submit + "made --overwrite").exit_code, 0) << "of what is ours";
  EXPECT_FALSE(fs::exists(folder_ / "made/job/cases"));
  fs::create_directories(folder_ / "far/deep");
  fs::create_directory_symlink("far/deep", folder_ / "link");
  const ChildEnd behind = tether(submit + "link/../linked");
  EXPECT_EQ(behind.exit_code, 0) << behind.errors;
  EXPECT_TRUE(fs::exists(folder_ / "far/linked/job/job.json")) << "where the system finds it";
  EXPECT_EQ(tether("status link/../linked").exit_code, 0);
}

TEST_F(FrontEnd, KeepsAnotherCasesResults) {
  EXPECT_EQ(tether("simulate case.yaml --output results").exit_code, 0);
  EXPECT_EQ(tether("simulate case.yaml --output results").exit_code, 0) << "the same case may run again";
  std::ofstream(folder_ / "other.yaml") << "name: aorta\nunits: cgs\ntime: {step: 0.1, end: 0.2}\n";
  const ChildEnd refused = tether("simulate other.yaml --output results");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(
      refused.errors,
      "results: holds the results of the case 'tube'; choose another folder with --output, or give --overwrite\n");
  EXPECT_EQ(tether("simulate other.yaml --output results --overwrite").exit_code, 0);
}

TEST_F(FrontEnd, DescribesEachFieldOnce) {
  program("solid", "echo 'solid.density [g/cm3]  (number)'; echo '    mass per volume'");
  const std::string text = tether("describe").output;
  EXPECT_TRUE(text.starts_with(
      "fluid.density [g/cm3]  (number)\n    mass per volume\nsolid.density [g/cm3]  (number)\n    mass per volume\n"
      "diagnosis  (section)\n"))
      << "each program's fields, and then its own:\n"
      << text;
}

TEST_F(FrontEnd, WritesMeshesForViewing) {
  std::ofstream(folder_ / "case.yaml", std::ios::app)
      << "mesh: {source: swept, swept: {radius: 1, length: 3, wall_thickness: 0.1, around: 12, along: 5, "
         "regions: {all: {}}}}\nsolid: {element: p1}\n";
  const ChildEnd end = tether("mesh case.yaml --output results");
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("wall_faces.vtu    colour by face: 0 interface, 1 all, 2 inlet_ring, 3 outlet_ring\n"),
            std::string::npos)
      << end.output;
  EXPECT_NE(end.output.find("regions.vtu       colour by region: 0 all\n"), std::string::npos) << end.output;
  EXPECT_NE(end.output.find("  lumen 19."), std::string::npos) << "a polygon in a circle of 20 mm";
  EXPECT_NE(end.output.find("  wall   216 nodes, 720 elements"), std::string::npos) << "three tetrahedra a prism";
  for (const char* name : {"fluid", "wall", "fluid_faces", "wall_faces", "regions"})
    EXPECT_GT(fs::file_size(folder_ / "results/mesh" / (std::string(name) + ".vtu")), 1000u) << name;
}

TEST_F(FrontEnd, MeshesLeaveTheMarkOfARun) {
  const auto write_case = [&](double length) {
    std::ofstream(folder_ / "case.yaml")
        << "name: tube\nunits: cgs\ntime: {step: 0.1, end: 0.2}\nsolid: {element: p1}\n"
        << "mesh: {source: swept, swept: {radius: 1, wall_thickness: 0.1, around: 12, along: 5, regions: {all: {}}, "
        << "length: " << length << "}}\n";
  };
  write_case(3);
  EXPECT_EQ(tether("mesh case.yaml --output results").exit_code, 0);
  write_case(4);
  EXPECT_EQ(tether("mesh case.yaml --output results").exit_code, 0);
  EXPECT_NE(content("results/case_as_run.yaml").find("length: 4"), std::string::npos) << "of meshes alone";
  const std::string mark = content("results/case_as_run.yaml");
  std::ofstream(folder_ / "results/summary.json") << "{}";
  write_case(5);
  const ChildEnd end = tether("mesh case.yaml --output results");
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(content("results/case_as_run.yaml"), mark);
  EXPECT_NE(end.output.find("of the case as it is now"), std::string::npos) << end.output;
}

TEST_F(FrontEnd, NamesWhatIsNotBuilt) {
  fs::remove(folder_ / "fsi_master");
  const ChildEnd end = tether("simulate case.yaml");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.errors, (folder_ / "fsi_master").string() + ": no such program; is Tether built?\n");
}

TEST_F(FrontEnd, ListsItsVerbs) {
  EXPECT_EQ(tether("--help").exit_code, 0);
  EXPECT_EQ(tether("").exit_code, 2);
  EXPECT_EQ(tether("simulte case.yaml").exit_code, 2);
  EXPECT_NE(tether("simulte case.yaml").errors.find("tether: unknown verb 'simulte'"), std::string::npos);
  EXPECT_EQ(tether("mesh case.yaml --steps 3").exit_code, 2) << "it makes none";
  EXPECT_EQ(tether("score case.yaml --resume").exit_code, 2);
}

TEST_F(FrontEnd, HelpNamesWhatEachVerbWorksOn) {
  const std::string verbs = tether("--help").output;
  const auto help_of = [&](const std::string& verb, const std::string& argument) {
    const ChildEnd end = tether(verb + " --help");
    EXPECT_EQ(end.exit_code, 0) << verb;
    EXPECT_TRUE(std::regex_search(verbs, std::regex("\n  " + verb + " +" + argument + "  "))) << verb;
    return end.output;
  };
  for (const char* verb : {"simulate", "compare", "explain", "diagnose", "twin", "identify", "validate", "mesh"}) {
    const std::string help = help_of(verb, "CASE.yaml");
    EXPECT_NE(help.find(std::string("Usage: tether ") + verb + " [OPTIONS] [CASE.yaml]\n"), std::string::npos) << help;
    EXPECT_TRUE(std::regex_search(help, std::regex("\n  CASE.yaml +the case file\n"))) << help;
  }
  for (const auto& [verb, argument, meaning] : {std::tuple("score", "CASE.yaml|DIR", "the case that tether twin wrote"),
                                                {"report", "DIR", "the folder of results"},
                                                {"build-model", "STUDY.yaml", "the study file"},
                                                {"fit-outlets", "OUTLETS.yaml", "the outlets file"},
                                                {"track-ring", "RING.yaml", "the ring file"},
                                                {"measure-noise", "CASE.yaml", "with measurements"}}) {
    const std::string help = help_of(verb, std::regex_replace(argument, std::regex("\\|"), "\\|"));
    EXPECT_NE(help.find(fmt::format("Usage: tether {} [OPTIONS] [{}]\n", verb, argument)), std::string::npos) << help;
    EXPECT_NE(help.find(meaning), std::string::npos) << help;
    const ChildEnd without = tether(verb);
    EXPECT_EQ(without.exit_code, 2) << verb;
    EXPECT_TRUE(without.errors.starts_with(std::string(argument) + " is missing: ")) << without.errors;
  }
  const auto has = [&](const std::string& verb, const char* option) {
    return tether(verb + " --help").output.find(option) != std::string::npos;
  };
  for (const auto& [verb, steps, processes, runs] : {std::tuple("simulate", true, false, false),
                                                     {"compare", true, false, false},
                                                     {"identify", true, true, false},
                                                     {"diagnose", false, true, true},
                                                     {"explain", false, true, true},
                                                     {"twin", false, false, false}}) {
    EXPECT_EQ(has(verb, "--steps"), steps) << verb;
    EXPECT_EQ(has(verb, "--processes"), processes) << verb;
    EXPECT_EQ(has(verb, "--runs"), runs) << verb;
  }
  EXPECT_NE(tether("measure-noise --help").output.find("tether measure-noise FIRST SECOND"), std::string::npos);
  for (const auto& [verb, argument] :
       {std::pair("submit", "VERB CASE.yaml"), {"status", "FOLDER"}, {"results", "FOLDER"}, {"schema", "\\[FILE\\]"}})
    EXPECT_FALSE(help_of(verb, std::string(argument) + ".*").empty()) << verb;
  const std::string describe = help_of("describe", "");
  EXPECT_NE(describe.find("Usage: tether describe [OPTIONS]\n"), std::string::npos) << describe;
  for (const char* of_results : {"--output", "--overwrite", "--validate", "CASE"})
    EXPECT_EQ(describe.find(of_results), std::string::npos) << of_results;
}

/// What a person was to read and did not get is no success.
TEST_F(FrontEnd, FailsWhereWhatItTellsIsLost) {
  program("solid", "echo 'solid.density [g/cm3]  (number)'; echo '    mass per volume'");
  for (const char* words : {"describe", "schema", "schema summary.json", "--help", "simulate --help"}) {
    const ChildEnd end = tether(std::string(words) + " >/dev/full");
    EXPECT_EQ(end.exit_code, 1) << words;
    EXPECT_EQ(end.errors, "tether: what it tells cannot be written: is the disk full?\n") << words;
  }
}

/// Nor an error where nobody reads it: `| head`.
TEST_F(FrontEnd, DoesItsWorkWhereNobodyReadsAnyMore) {
  const ChildEnd end = capture(
      {{"/bin/sh", "-c", "cd " + folder_.string() + " && { sleep 0.3; ./tether schema; echo $? >code; } | true"}, {}});
  EXPECT_EQ(end.errors, "");
  std::ifstream code(folder_ / "code");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(code), {}), "0\n");
}

TEST_F(FrontEnd, NamesAFolderOfTemporaryFilesThatIsNone) {
  const ChildEnd end = capture(
      {{"/bin/sh", "-c", "cd " + folder_.string() + " && TMPDIR=/nonexistent ./tether simulate case.yaml"}, {}});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.errors,
            "TMPDIR: /nonexistent: must name a folder, for the notes that a run's programs leave each other\n");
}

TEST_F(FrontEnd, SaysWhatCannotBeMadeToConform) {
  const ChildEnd end = capture({{TETHER_PROGRAM, "conform", folder_.string()}, {}});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.errors, "tether_conform: the program: " + folder_.string() + " cannot be executed\n");
  EXPECT_EQ(capture({{TETHER_PROGRAM, "conform", "--ranks", "2", "--", folder_.string()}, {}}).errors, end.errors);
  const ChildEnd help = capture({{TETHER_PROGRAM, "conform", "--help"}, {}}),
                 without = capture({{TETHER_PROGRAM, "conform"}, {}});
  EXPECT_EQ(capture({{TETHER_PROGRAM, "conform", "--"}, {}}).errors, "tether_conform: " + without.errors);
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_TRUE(
      help.output.starts_with("tether conform [--dt SECONDS] [--ranks N] [--with PROGRAM] PROGRAM [ARGUMENTS]: "));
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_EQ(without.errors, help.output);
  for (const char* dt : {"1,5", "x", "0", "11", "1e-3 s"}) {
    const ChildEnd no_step = capture({{TETHER_PROGRAM, "conform", "--dt", dt, "/bin/true"}, {}});
    EXPECT_EQ(no_step.exit_code, 2) << dt;
    EXPECT_NE(no_step.errors.find(fmt::format("--dt: {}: must be a number from 1e-09 to 10 s", dt)), std::string::npos)
        << no_step.errors;
  }
  for (const char* ranks : {"0", "two", "1.5", "99999999999"})
    EXPECT_EQ(capture({{TETHER_PROGRAM, "conform", "--ranks", ranks, "/bin/true"}, {}}).errors,
              fmt::format("tether_conform: --ranks: {}: must be a whole number from 1 to 1000\n", ranks));
}

}  // namespace front_end_test
}  // namespace tether
