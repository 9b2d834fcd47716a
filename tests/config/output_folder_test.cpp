#include "common/config/output_folder.hpp"

#include <sys/stat.h>

#include "common/base/folder_lock.hpp"
#include "common/base/input_stream.hpp"
#include "tests/config/case_text.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

std::string claim(const std::string& name, bool overwrite = false, const std::string& file = "case.yaml",
                  const std::string& folder = "results") {
  const auto path = write_file(file, "name: " + name + "\nunits: cgs\ntime: {step: 0.1, end: 1}\n");
  CommandLine command;
  command.output = test_folder() / folder;
  command.overwrite = overwrite;
  return input_error_of([&] { claim_and_mark_output(command, CaseFile(path)); });
}

class OutputFolder : public ::testing::Test {};

TEST_F(OutputFolder, IsMadeAndMayBeUsedAgainByTheSameCase) {
  EXPECT_EQ(claim("tube"), "no error");
  std::ofstream(test_folder() / "results" / "summary.json") << "{}";
  EXPECT_EQ(claim("tube"), "no error");
  EXPECT_TRUE(std::filesystem::exists(test_folder() / "results" / case_as_run));
}

/// The mark names the case in a comment: what follows an end of line there would be of the case.
TEST_F(OutputFolder, AndCaseHavePathsOfOneLine) {
  const std::string rule =
      ": its path holds control characters (an end of line, a tab; here ?): rename the file or folder";
  for (const std::string sign : {"\n", "\t", "\r", "\x1b"}) {
    std::filesystem::create_directories(test_folder() / ("a" + sign + "name: evil"));
    EXPECT_EQ(claim("tube", false, "a" + sign + "name: evil/case.yaml"), "a?name: evil/case.yaml" + rule);
  }
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "results"));
  std::filesystem::create_directory_symlink("a\nname: evil", test_folder() / "link");
  EXPECT_EQ(claim("tube", false, "link/case.yaml"), "a?name: evil/case.yaml" + rule);
  for (const std::string folder : {"b\n", "link", "b\n/c"})
    EXPECT_NE(input_error_of([&] { hold_output(test_folder() / folder); }).find(rule), std::string::npos) << folder;
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "b\n"));
  EXPECT_NE(input_error_of([&] {
              claim_for_made(test_folder() / "noise", false, "measure-noise", {test_folder() / "a\n.stl"});
            }).find(rule),
            std::string::npos);
}

TEST_F(OutputFolder, IsRefusedToAnotherCase) {
  EXPECT_EQ(claim("tube"), "no error");
  EXPECT_EQ(claim("aorta"),
            "results: holds the results of the case 'tube'; choose another folder with --output, or give --overwrite");
  EXPECT_EQ(claim("aorta", true), "no error");
  EXPECT_EQ(claim("aorta"), "no error") << "it is this case's from then on";
}

/// A case that was copied and edited keeps its name, and must not cost the first one's results.
TEST_F(OutputFolder, IsRefusedToAnotherFileOfTheSameName) {
  EXPECT_EQ(claim("tube"), "no error");
  EXPECT_TRUE(claim("tube", false, "copy.yaml")
                  .starts_with("results: holds the results of another case file of the name 'tube' ("));
  EXPECT_EQ(claim("tube", true, "copy.yaml"), "no error");
}

/// A project that was moved or copied is the same one.
TEST_F(OutputFolder, IsOfACaseThatWasMovedWithIt) {
  std::filesystem::create_directories(test_folder() / "project");
  EXPECT_EQ(claim("tube", false, "project/case.yaml", "project/results"), "no error");
  std::filesystem::copy(test_folder() / "project", test_folder() / "copy", std::filesystem::copy_options::recursive);
  EXPECT_EQ(claim("tube", false, "copy/case.yaml", "copy/results"), "no error");
  EXPECT_NE(claim("tube", false, "project/case.yaml", "copy/results"), "no error") << "that of the copy's case";
  const auto put = [](const std::filesystem::path& from, const std::filesystem::path& to) {  // this process holds it
    std::filesystem::copy(from, to, std::filesystem::copy_options::recursive);
    std::filesystem::remove_all(from);
  };
  put(test_folder() / "copy", test_folder() / "moved");
  EXPECT_EQ(claim("tube", false, "moved/case.yaml", "moved/results"), "no error");
  put(test_folder() / "moved/results", test_folder() / "elsewhere");
  EXPECT_EQ(claim("tube", false, "moved/case.yaml", "elsewhere"), "no error") << "its case is where it was";
}

/// A case is the same by whatever way it is called, and none by a way that only looks like another's.
TEST_F(OutputFolder, IsOfACaseByWhateverWayItIsCalled) {
  std::filesystem::create_directories(test_folder() / "store/ada");
  std::filesystem::create_directories(test_folder() / "patients");
  std::filesystem::create_directory_symlink("../store/ada", test_folder() / "patients/ada");
  EXPECT_EQ(claim("tube", false, "store/x.yaml"), "no error");
  EXPECT_EQ(claim("tube", false, "patients/ada/../x.yaml"), "no error");
  EXPECT_TRUE(claim("tube", false, "patients/x.yaml")
                  .starts_with("results: holds the results of another case file of the name 'tube' ("));
}

/// A longer case in another file goes on with the run; whether it is the same one, its checkpoint says.
TEST_F(OutputFolder, MayBeResumedByAnotherFile) {
  EXPECT_EQ(claim("tube"), "no error");
  const auto path = write_file("longer.yaml", "name: longer\nunits: cgs\ntime: {step: 0.1, end: 2}\n");
  CommandLine command;
  command.output = test_folder() / "results";
  command.resume = true;
  EXPECT_EQ(input_error_of([&] { claim_output(command, CaseFile(path)); }), "no error");
  std::filesystem::remove(test_folder() / "results" / case_as_run);
  std::ofstream(test_folder() / "results" / "thesis.txt") << "precious";
  EXPECT_NE(input_error_of([&] { claim_output(command, CaseFile(path)); }).find("are not the results of a run"),
            std::string::npos);
}

TEST_F(OutputFolder, IsNotTakenFromOtherFiles) {
  write_file("results", "a file");
  EXPECT_EQ(claim("tube"), "results: is not a folder");
  std::filesystem::remove(test_folder() / "results");
  std::filesystem::create_directories(test_folder() / "results");
  EXPECT_EQ(claim("tube"), "no error") << "empty";
  std::filesystem::remove(test_folder() / "results" / case_as_run);
  std::ofstream(test_folder() / "results" / "thesis.txt") << "precious";
  EXPECT_EQ(claim("tube"),
            "results: holds files that are not the results of a run; choose another folder with --output, or give "
            "--overwrite");
}

/// What a refused claim leaves behind is nothing.
TEST_F(OutputFolder, IsNotTouchedWhereItIsRefused) {
  std::filesystem::create_directories(test_folder() / "results");
  std::ofstream(test_folder() / "results" / "thesis.txt") << "precious";
  EXPECT_NE(claim("tube"), "no error");
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "results" / folder_lock_name));
}

/// To open a pipe that nobody writes to would wait without end.
TEST_F(OutputFolder, IsRefusedWhereAPipeStandsForAFile) {
  for (const char* name : {"case_as_run.yaml", "timeseries.csv"}) {
    std::filesystem::remove_all(test_folder() / "results");
    EXPECT_EQ(claim("tube"), "no error");
    std::filesystem::remove(test_folder() / "results" / name);
    ASSERT_EQ(mkfifo((test_folder() / "results" / name).c_str(), 0600), 0);
    for (const bool overwrite : {false, true})
      EXPECT_EQ(claim("tube", overwrite), std::string("results/") + name + ": is a pipe, not a file of results");
  }
}

/// What is written or removed through a link would be elsewhere.
TEST_F(OutputFolder, IsRefusedWhereALinkStandsForAFileOrAFolder) {
  std::filesystem::create_directories(test_folder() / "elsewhere");
  for (const char* name : {"plots", "timeseries.csv", folder_lock_name}) {
    std::filesystem::remove_all(test_folder() / "results");
    EXPECT_EQ(claim("tube"), "no error");
    std::filesystem::remove(test_folder() / "results" / name);
    std::filesystem::create_symlink("../elsewhere", test_folder() / "results" / name);
    for (const bool overwrite : {false, true})
      EXPECT_EQ(claim("tube", overwrite), std::string("results/") + name + ": is a link, not a file of results");
  }
}

TEST_F(OutputFolder, IsRefusedWhereAPlotIsALinkOrAPipe) {
  EXPECT_EQ(claim("tube"), "no error");
  std::filesystem::create_directories(test_folder() / "results/plots");
  write_file("results/plots/kept.png", "a picture");
  EXPECT_EQ(claim("tube"), "no error");
  std::filesystem::create_symlink("../../precious", test_folder() / "results/plots/wall.png");
  EXPECT_EQ(claim("tube"), "results/plots/wall.png: is a link, not a file of results");
  std::filesystem::remove(test_folder() / "results/plots/wall.png");
  ASSERT_EQ(mkfifo((test_folder() / "results/plots/plots.gp").c_str(), 0600), 0);
  EXPECT_EQ(claim("tube"), "results/plots/plots.gp: is a pipe, not a file of results");
}

/// Meshes, checkpoints and the runs of an explanation are written through folders below.
TEST_F(OutputFolder, IsRefusedWhereAFolderInItHoldsALinkOrAPipe) {
  for (const char* name : {"mesh/fluid.vtu", "model_0/checkpoint/fluid.bin", "force/run/vtk/wall_1.vtu", "model"}) {
    std::filesystem::remove_all(test_folder() / "results");
    EXPECT_EQ(claim("tube"), "no error");
    const auto place = test_folder() / "results" / name;
    std::filesystem::create_directories(place.parent_path());
    std::filesystem::create_symlink("/precious", place);
    for (const bool overwrite : {false, true})
      EXPECT_EQ(claim("tube", overwrite), std::string("results/") + name + ": is a link, not a file of results");
    std::filesystem::remove(place);
    ASSERT_EQ(mkfifo(place.c_str(), 0600), 0);
    EXPECT_EQ(claim("tube"), std::string("results/") + name + ": is a pipe, not a file of results");
  }
}

/// Several diagnoses share runs, and several twins a truth, by links to their folders.
TEST_F(OutputFolder, MayHoldRunsThatAreElsewhere) {
  std::filesystem::create_directories(test_folder() / "elsewhere");
  for (const char* name : {"coarse/runs/base", "sealed/run"}) {
    EXPECT_EQ(claim("tube"), "no error");
    const auto place = test_folder() / "results" / name;
    std::filesystem::create_directories(place.parent_path());
    std::filesystem::create_directory_symlink(test_folder() / "elsewhere", place);
    EXPECT_EQ(claim("tube"), "no error");
  }
  std::filesystem::create_symlink(write_file("precious", ""), test_folder() / "results/sealed/answer");
  EXPECT_EQ(claim("tube"), "results/sealed/answer: is a link, not a file of results");
}

TEST_F(OutputFolder, IsRefusedBeforeTheRunWhereItsPlotsCannotBeAFolder) {
  EXPECT_EQ(claim("tube"), "no error");
  write_file("results/plots", "a file");
  for (const bool overwrite : {false, true}) EXPECT_EQ(claim("tube", overwrite), "results/plots: is not a folder");
}

/// A run would remove a file that it reads, and the same command would then give another answer.
TEST_F(OutputFolder, IsNotWhereACaseReadsFrom) {
  EXPECT_EQ(claim("tube"), "no error");
  write_file("results/timeseries.csv", "time, flow\n");
  const std::string head = "name: tube\nunits: cgs\ntime: {step: 0.1, end: 1}\n";
  const auto refused = [&](const std::string& text) {
    const auto path = write_file("case.yaml", head + text);
    CommandLine command;
    command.output = test_folder() / "results";
    for (command.overwrite = false;; command.overwrite = true) {
      const std::string said = input_error_of([&] { claim_output(command, CaseFile(path)); });
      if (command.overwrite || said == "no error") return said;
    }
  };
  const std::string end =
      ": is read, and what is written into results would replace it; choose another folder with "
      "--output";
  EXPECT_EQ(refused("fluid: {file: results/timeseries.csv}\n"), "results/timeseries.csv" + end);
  EXPECT_EQ(refused("observations: {surfaces: {ct: {folder: results, pattern: 'a*'}}}\n"), "results" + end);
  EXPECT_EQ(refused("initial_state: {from: results}\n"), "results" + end);
  EXPECT_EQ(refused("diagnosis: {candidates: [results]}\n"), "no error") << "a word";
  std::filesystem::create_directory(test_folder() / "12");
  const auto by_number = write_file("case.yaml", head + "mesh: {swept: {around: 12}}\n");
  CommandLine command;
  command.output = test_folder() / "12";
  EXPECT_EQ(input_error_of([&] { claim_output(command, CaseFile(by_number)); }), "no error") << "a number";
}

/// For what a verb makes that is no run.
class MadeFolder : public OutputFolder {
 protected:
  void SetUp() override {
    write_file("ct.stl", "a surface");
    study_ = write_file("study.yaml", "name: arch\nsurface: {file: ct.stl}\n");
  }
  std::string claim(const std::filesystem::path& folder, bool overwrite = false,
                    const std::string& verb = "build-model", const std::string& file = "study.yaml") const {
    CommandLine command;
    command.case_file = test_folder() / file;
    command.output = test_folder() / folder;
    command.overwrite = overwrite;
    return input_error_of([&] { claim_for_made(command, {verb, "arch", {}, {"case.yaml"}, "quality.json"}); });
  }
  std::filesystem::path study_;
};

TEST_F(MadeFolder, IsMadeAndMayBeUsedAgainByTheSameVerbAndFile) {
  EXPECT_EQ(claim("made"), "no error");
  write_file("made/surface.vtp", "");
  EXPECT_EQ(claim("made"), "no error");
  write_file("other.yaml", "name: arch\n");
  EXPECT_EQ(claim("made", false, "build-model", "other.yaml"),
            "made: holds what tether build-model made of study.yaml; choose another folder with --output, or give "
            "--overwrite");
  EXPECT_EQ(claim("made", false, "fit-outlets"),
            "made: holds files that are not what tether fit-outlets made; choose another folder with --output, or give "
            "--overwrite");
  EXPECT_EQ(claim("made", true, "fit-outlets"), "no error");
}

TEST_F(MadeFolder, IsNotTakenFromOtherFiles) {
  std::filesystem::create_directories(test_folder() / "mine");
  write_file("mine/case.yaml", "precious");
  EXPECT_EQ(claim("mine"),
            "mine: holds files that are not what tether build-model made; choose another folder with --output, or give "
            "--overwrite");
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "mine" / folder_lock_name));
  EXPECT_FALSE(std::filesystem::exists(test_folder() / "mine" / made_by));
}

/// A project that was moved or copied is the same one, and what a person changed in it is known still.
TEST_F(MadeFolder, IsOfAFileThatWasMovedWithIt) {
  std::filesystem::create_directories(test_folder() / "project");
  write_file("project/study.yaml", "name: arch\n");
  EXPECT_EQ(claim("project/made", false, "build-model", "project/study.yaml"), "no error");
  write_file("project/made/quality.json", "{}"), write_file("project/made/case.yaml", "as made");
  note_coming(test_folder() / "project/made", {{"case.yaml", test_folder() / "project/made/case.yaml"}});
  std::filesystem::copy(test_folder() / "project", test_folder() / "copy", std::filesystem::copy_options::recursive);
  EXPECT_EQ(claim("copy/made", false, "build-model", "copy/study.yaml"), "no error");
  write_file("copy/made/case.yaml", "mine");
  EXPECT_NE(claim("copy/made", false, "build-model", "copy/study.yaml").find("is not as tether build-model made it"),
            std::string::npos);
}

TEST_F(MadeFolder, HoldsNothingWhereTheFileWasRefused) {
  EXPECT_EQ(claim("made"), "no error");
  write_file("other.yaml", "name: arch\n");
  EXPECT_EQ(claim("made", false, "build-model", "other.yaml"), "no error") << "a mark is no result";
  write_file("made/surface.vtp", "");
  EXPECT_EQ(claim("made", false, "build-model", "other.yaml"), "no error") << "it is the other one's now";
  EXPECT_NE(claim("made"), "no error");
}

/// Not with --overwrite either: what is made of a file cannot stand in its place.
TEST_F(MadeFolder, IsNotWhereTheFilesAreThatAreRead) {
  EXPECT_EQ(claim(".", true),
            "ct.stl: is read, and what is written into . would replace it; choose another folder with --output");
  EXPECT_EQ(claim("made"), "no error");
  write_file("made/surface.vtp", "");
  write_file("study.yaml", "name: arch\nsurface: {file: made/surface.vtp}\n");
  for (const bool overwrite : {false, true})
    EXPECT_EQ(claim("made", overwrite),
              "made/surface.vtp: is read, and what is written into made would replace it; choose another folder with "
              "--output");
}

/// A case that a verb made is a beginning: what a person made of it is not replaced.
TEST_F(MadeFolder, KeepsAFileToGoOnWithThatWasChanged) {
  EXPECT_EQ(claim("made"), "no error");
  write_file("made/case.yaml", "mine");
  for (const bool overwrite : {false, true})
    EXPECT_EQ(claim("made", overwrite),
              "made/case.yaml: is not what tether build-model made, and would be replaced; choose another folder with "
              "--output")
        << "what is made before it is not there";
  write_file("made/quality.json", "{}");
  write_file("made/case.yaml", "as made");
  note_coming(test_folder() / "made", {{"case.yaml", test_folder() / "made/case.yaml"}});
  EXPECT_EQ(claim("made"), "no error");
  EXPECT_EQ(claim("made"), "no error") << "the note is still there";
  write_file("made/case.yaml", "as a person wants it");
  EXPECT_EQ(claim("made"),
            "made/case.yaml: is not as tether build-model made it, and would be replaced; keep it elsewhere, or give "
            "--overwrite");
  EXPECT_EQ(claim("made", true), "no error");
  std::filesystem::remove(test_folder() / "made/quality.json");
  write_file("made/case.yaml", "as made");
  EXPECT_TRUE(claim("made", true, "fit-outlets").starts_with("made/case.yaml: is not what tether fit-outlets made, "))
      << "but what another verb made";
}

/// Whenever a verb is killed, its own command finds what it knows: what was there, or what was about to be.
TEST_F(MadeFolder, KnowsWhatIsAboutToStandInIt) {
  EXPECT_EQ(claim("made"), "no error");
  const std::filesystem::path made = test_folder() / "made";
  write_file("made/quality.json", "{}"), write_file("made/.new_case.yaml", "first");
  note_coming(made, {{"case.yaml", made / ".new_case.yaml"}});
  EXPECT_EQ(claim("made"), "no error") << "not there yet";
  std::filesystem::rename(made / ".new_case.yaml", made / "case.yaml");
  EXPECT_EQ(claim("made"), "no error");
  write_file("made/.new_case.yaml", "second");
  note_coming(made, {{"case.yaml", made / ".new_case.yaml"}});
  EXPECT_EQ(claim("made"), "no error") << "still the first one";
  std::filesystem::rename(made / ".new_case.yaml", made / "case.yaml");
  EXPECT_EQ(claim("made"), "no error");
  write_file("made/case.yaml", "mine"), write_file("made/.new_case.yaml", "third");
  EXPECT_EQ(message_of([&] {
              note_coming(made, {{"case.yaml", made / ".new_case.yaml"}});
            }),
            (made / "case.yaml").string() +
                ": was changed while its next version was made, and is kept; keep it elsewhere, and give the same "
                "command");
  EXPECT_NE(claim("made"), "no error") << "what a person made is not taken for the verb's";
  EXPECT_EQ(claim("made", true), "no error");
  note_coming(made, {{"case.yaml", made / ".new_case.yaml"}});
  write_file("made/case.yaml", "mine again");
  EXPECT_NE(message_of([&] {
              note_coming(made, {{"case.yaml", made / ".new_case.yaml"}});
            }),
            "accepted")
      << "--overwrite means what was there when the command began";
}

/// Of a folder of results: several verbs leave theirs there.
TEST_F(MadeFolder, OfResultsKeepsAFileToGoOnWithThatWasChanged) {
  const std::filesystem::path run = test_folder() / "run";
  std::filesystem::create_directories(run);
  const auto make = [&](const char* name, const std::string& text) {
    return make_to_go_on_with(run, name, [&](const std::filesystem::path& file) { std::ofstream(file) << text; });
  };
  const auto checked = [&] { return input_error_of([&] { check_unchanged(run, "diagnose", {"suggested.yaml"}); }); };
  const auto replaceable = [&](bool overwrite) {
    return input_error_of([&] { check_replaceable(run, "diagnose", {"suggested.yaml"}, overwrite); });
  };
  write_file("run/suggested.yaml", "of an earlier version");
  EXPECT_EQ(checked(), "no error");
  EXPECT_EQ(replaceable(false),
            "run/suggested.yaml: nothing says that tether diagnose made it (made_by.txt is missing or of an earlier "
            "version), and it would be replaced; keep it elsewhere, or give --overwrite");
  EXPECT_EQ(replaceable(true), "no error");
  EXPECT_TRUE(make("suggested.yaml", "made"));
  EXPECT_EQ(replaceable(false), "no error");
  EXPECT_EQ(checked(), "no error");
  write_file("run/suggested.yaml", "mine");
  EXPECT_TRUE(make("identified.yaml", "another verb's"));
  EXPECT_EQ(checked(),
            "run/suggested.yaml: is not as tether diagnose made it, and would be replaced; keep it elsewhere, or give "
            "--overwrite");
  EXPECT_FALSE(make_to_go_on_with(run, "suggested.yaml", [](const std::filesystem::path&) {}));
  std::ifstream kept(run / "suggested.yaml");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), "mine") << "where nothing is suggested";
  EXPECT_EQ(message_of([&] { make("suggested.yaml", "made anew"); }),
            (run / "suggested.yaml").string() +
                ": was changed while its next version was made, and is kept; the new one is suggested.new.yaml");
  EXPECT_EQ(content_of(run / "suggested.yaml"), "mine");
  EXPECT_EQ(content_of(run / "suggested.new.yaml"), "made anew");
  EXPECT_EQ(replaceable(true), "no error");
  EXPECT_TRUE(make("suggested.yaml", "made anew"));
  EXPECT_EQ(checked(), "no error");
}

/// A folder of surfaces is read as a file is.
TEST_F(MadeFolder, IsNotWhereAFolderIsThatIsRead) {
  std::filesystem::create_directories(test_folder() / "scans/data");
  write_file("scans/data/lumen_01.ply", "of a patient");
  write_file("study.yaml", "name: arch\nobservations: {surfaces: {ct: {folder: scans/data}}}\n");
  EXPECT_NE(claim("scans", true).find("is read, and what is written into scans would replace it"), std::string::npos);
  EXPECT_EQ(claim("scans/made"), "no error");
}

/// Of files that are no cases: binary ones are not read as such.
TEST_F(MadeFolder, IsOfTwoFilesToo) {
  const auto a = write_file("a.stl", std::string("\0\1: [", 5)), b = write_file("b.stl", "another");
  const auto claim_of = [&](const std::filesystem::path& first, const std::string& folder, bool overwrite = false) {
    return input_error_of([&] { claim_for_made(test_folder() / folder, overwrite, "measure-noise", {first, b}); });
  };
  EXPECT_EQ(claim_of(a, "made"), "no error");
  write_file("made/noise.json", "");
  EXPECT_EQ(claim_of(a, "made"), "no error");
  EXPECT_TRUE(claim_of("c.stl", "made").starts_with("made: holds what tether measure-noise made of "));
  EXPECT_EQ(claim_of("c.stl", "made", true), "no error");
  EXPECT_EQ(claim_of(a, ".", true),
            "a.stl: is read, and what is written into . would replace it; choose another folder with --output");
}

}  // namespace
}  // namespace tether
