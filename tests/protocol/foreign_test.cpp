#include <gtest/gtest.h>

#include <fstream>

#include "tests/io/temporary_folder.hpp"
#include "tests/protocol/run_job.hpp"
#include "tests/sanitizers/built_with.hpp"

/// Codes in C and Python take the place of ours: the examples of docs/protocol.md, as they stand there.
namespace tether::tests {
namespace {

const std::string python_solid = std::string(TETHER_SOURCE) + "/docs/examples/spring_solid.py";
const Environment python_path{{"PYTHONPATH", std::string(TETHER_SOURCE) + "/tools/python"},
                              {"TETHER_CLIENT", product_program("../lib/libtether_client.so")},
                              {"PYTHONDONTWRITEBYTECODE", "1"}};

/// What a run of three steps tells of them.
std::string steps_of(const JobResult& job) {
  EXPECT_EQ(job.exit_code, 0) << job.errors;
  const auto start = job.output.find("step 0");
  EXPECT_NE(start, std::string::npos) << job.output;
  EXPECT_NE(job.output.find("step 2"), std::string::npos) << job.output;
  return start == std::string::npos ? "" : job.output.substr(start);
}

std::string example(const std::string& name) {
  return test_program("example_" + name);
}

JobResult couple(const std::string& fluid, const std::string& solid) {
  return run_job({test_program("fake_master"), fluid, solid, "3"}, python_path);
}

/// A line of one master, two processes of the fluid and one of the solid.
JobResult run_mpmd(const std::string& fluid, const std::string& solid) {
  auto words = mpirun();
  words.insert(words.end(),
               {"-n", "1", test_program("fake_master"), "x", "x", "3", ":", "-n", "2", fluid, ":", "-n", "1", solid});
  return run_job(words);
}

void expect_conforms(const std::string& program) {
  const auto job = run_job({product_program("tether_conform"), program}, python_path);
  EXPECT_EQ(job.exit_code, 0) << program << "\n" << job.output << job.errors;
  EXPECT_EQ(job.output.find("FAIL"), std::string::npos);
  EXPECT_NE(job.output.find("PASS  stops when told"), std::string::npos) << job.output;
  EXPECT_TRUE(job.orphans.empty());
}

void expect_tells_its_velocity(const std::string& program) {
  const auto job = run_job({product_program("tether_conform"), program}, python_path);
  EXPECT_EQ(job.exit_code, 0) << program << "\n" << job.output << job.errors;
  EXPECT_NE(job.output.find("PASS  tells its velocity inside, and none outside"), std::string::npos) << job.output;
}

/// The wall of docs/couple-your-code.md, with Tether's blood beside it.
void expect_fits_our_blood() {
  const std::string examples = std::string(TETHER_SOURCE) + "/docs/examples/";
  const auto job = run_job({product_program("tether_conform"), "--dt", "2e-3", "--with", product_program("fluid"),
                            examples + "ring_solid.py", examples + "ring_tube.yaml"},
                           python_path);
  EXPECT_EQ(job.exit_code, 0) << job.output << job.errors;
  EXPECT_EQ(job.output.find("FAIL"), std::string::npos) << job.output;
  EXPECT_NE(job.output.find("by mortar: 504 nodes of the fluid, 320 of the wall"), std::string::npos) << job.output;
  EXPECT_NE(job.output.find("PASS  a state set again continues bit for bit"), std::string::npos) << job.output;
}

/// Tether's own codes are held to what it asks of others, at the step at which its wall's factor is worst in single
/// precision, and in several processes.
void expect_own_conforms(const std::string& code, const std::vector<std::string>& options) {
  std::vector<std::string> words{product_program("tether_conform")};
  words.insert(words.end(), options.begin(), options.end());
  words.insert(words.end(), {product_program(code), std::string(TETHER_SOURCE) + "/configs/tube/case.yaml"});
  const auto job = run_job(words, {});
  EXPECT_EQ(job.exit_code, 0) << code << "\n" << job.output << job.errors;
  EXPECT_EQ(job.output.find("FAIL"), std::string::npos) << job.output;
  EXPECT_NE(job.output.find("PASS  stops when told"), std::string::npos) << job.output;
}

/// A library compiled with the thread sanitizer cannot be loaded by a program that is not.
class ForeignPython : public ::testing::Test {
 protected:
  void SetUp() override {
    if (with_thread_sanitizer) GTEST_SKIP() << "Python cannot load a library compiled with the thread sanitizer";
  }
};

TEST(Foreign, C_codes_give_the_numbers_of_ours) {
  const std::string ours = steps_of(couple("fake_fluid", "fake_solid"));
  EXPECT_EQ(steps_of(couple("fake_fluid", example("spring_solid"))), ours);
  EXPECT_EQ(steps_of(couple(example("linear_fluid"), "fake_solid")), ours);
}

TEST_F(ForeignPython, A_wall_of_sixty_lines_fits_our_blood) {
  expect_fits_our_blood();
}

TEST_F(ForeignPython, Codes_give_the_numbers_of_ours) {
  EXPECT_EQ(steps_of(couple("fake_fluid", python_solid)), steps_of(couple("fake_fluid", "fake_solid")));
}

TEST(Foreign, A_c_code_of_two_processes_takes_part_in_an_mpmd_line) {
  const auto job = run_mpmd(example("linear_fluid"), example("spring_solid"));
  EXPECT_EQ(job.exit_code, 0) << job.errors;
  EXPECT_EQ(steps_of(job), steps_of(couple("fake_fluid", "fake_solid")));
  EXPECT_TRUE(job.orphans.empty());
}

TEST(Foreign, A_code_too_many_on_an_mpmd_line_is_told) {
  const auto job = run_mpmd(test_program("fake_fluid"), test_program("fake_solid"));
  EXPECT_EQ(job.exit_code, 2) << job.errors;
  EXPECT_NE(job.errors.find("the mpirun line has a fluid too many for this fake_master"), std::string::npos)
      << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

TEST(Foreign, So_do_our_own_codes) {
  for (const char* code : {"fluid", "solid"}) {
    expect_own_conforms(code, {});
    expect_own_conforms(code, {"--ranks", "2"});
  }
}

TEST(Foreign, Examples_conform) {
  for (const char* name : {"spring_solid", "linear_fluid"}) expect_conforms(example(name));
}

TEST_F(ForeignPython, Examples_conform) {
  expect_conforms(python_solid);
}

TEST(Foreign, Fluids_tell_their_velocity) {
  expect_tells_its_velocity(example("linear_fluid"));
}

TEST_F(ForeignPython, Fluids_tell_their_velocity) {
  expect_tells_its_velocity(std::string(TETHER_SOURCE) + "/tests/fakes/velocity_fluid.py");
}

TEST_F(ForeignPython, With_mpi_of_its_own_it_conforms) {
  const std::string code =
      "import runpy, tether; from mpi4py import MPI; plain = tether.serve; "
      "tether.serve = lambda role, make: plain(role, make, MPI.COMM_WORLD); runpy.run_path('" +
      python_solid + "')";
  const auto job = run_job({product_program("tether_conform"), "/usr/bin/python3", "-c", code}, python_path);
  EXPECT_EQ(job.exit_code, 0) << job.output << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

/// Both processes of a code make it and answer, on a line that has other programs.
TEST_F(ForeignPython, All_processes_of_a_code_answer_together) {
  const std::string code =
      "import runpy, sys, tether; plain = tether.serve\n"
      "def summed(solid, communicator):\n"
      "    answer = solid.evaluate\n"
      "    solid.evaluate = lambda load: answer(communicator.allreduce(load) / 2)\n"
      "    return solid if communicator.size == 2 else sys.exit('not two processes')\n"
      "tether.serve = lambda role, make: plain(role, lambda own: summed(make(), own), together=True)\n"
      "runpy.run_path('" +
      python_solid + "')";
  auto words = mpirun();
  words.insert(words.end(), {"-n", "1", test_program("fake_master"), "x", "x", "3", ":", "-n", "1",
                             test_program("fake_fluid"), ":", "-n", "2", "/usr/bin/python3", "-c", code});
  const auto job = run_job(words, python_path);
  EXPECT_EQ(job.exit_code, 0) << job.errors;
  EXPECT_EQ(steps_of(job), steps_of(couple("fake_fluid", "fake_solid")));
  EXPECT_TRUE(job.orphans.empty());
}

/// Each would send the master an answer of its own.
TEST_F(ForeignPython, Several_processes_that_do_not_serve_together_are_told) {
  const TemporaryFolder folder;
  const std::string examples = std::string(TETHER_SOURCE) + "/docs/examples/";
  const std::string file = (folder.path() / "case.yaml").string();
  std::ofstream(file) << "base: " << examples
                      << "ring_tube.yaml\ncoupling: {ranks: {solid: 2}, programs: {solid: " << examples
                      << "ring_solid.py}}\n";
  const auto job =
      run_job({product_program("tether"), "simulate", file, "--output", (folder.path() / "out").string()}, python_path);
  EXPECT_EQ(job.exit_code, 1) << job.output;
  EXPECT_NE(job.errors.find("solid: 2 processes (coupling.ranks), each of which would answer alone: let them serve "
                            "together (Python: together=True; C: a communicator for tether_connect)\n"),
            std::string::npos)
      << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

/// The master hears of it although all processes take leave together.
TEST_F(ForeignPython, What_one_of_several_processes_refuses_is_told) {
  const TemporaryFolder folder;
  const auto file = [&folder](const char* name) { return (folder / name).string(); };
  std::ofstream(file("solid.py")) << "#!/usr/bin/python3\nimport sys, tether\n"
                                     "def make(communicator):\n    raise ValueError('no file wall.dat')\n"
                                     "sys.exit(tether.serve('solid', make, together=True))\n";
  std::filesystem::permissions(file("solid.py"), std::filesystem::perms::owner_all);
  std::ofstream(file("case.yaml")) << "base: " << TETHER_SOURCE << "/docs/examples/ring_tube.yaml\n"
                                   << "coupling: {ranks: {solid: 2}, programs: {solid: ./solid.py}}\n";
  const auto job =
      run_job({product_program("tether"), "simulate", file("case.yaml"), "--output", file("out")}, python_path);
  EXPECT_EQ(job.exit_code, 2) << job.output;
  EXPECT_NE(job.errors.find("fsi_master: solid: ValueError: no file wall.dat (solid.py:4)\n"), std::string::npos)
      << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

/// A wall in two processes, the second of which sends itself a signal in its second step, while the first waits for it
/// inside MPI.
JobResult run_with_signal_in_second(const std::string& signal) {
  const TemporaryFolder folder;
  const auto file = [&folder](const char* name) { return (folder / name).string(); };
  std::ofstream(file("solid.py"))
      << "#!/usr/bin/python3\nimport os, runpy, signal, tether\nplain = tether.serve\n"
         "def signalled(wall, own):\n"
         "    begin = wall.begin_step\n"
         "    def begin_step(step, time, dt, predicted):\n"
         "        if own.rank == 1 and step == 2:\n"
         "            os.kill(os.getpid(), signal."
      << signal
      << ")\n"
         "        begin(step, time, dt, predicted)\n"
         "    wall.begin_step = begin_step\n"
         "    return wall\n"
         "tether.serve = lambda role, make: plain(role, lambda own: signalled(make(), own), "
         "together=True)\n"
         "runpy.run_path('"
      << TETHER_SOURCE << "/docs/examples/ring_solid.py')\n";
  std::filesystem::permissions(file("solid.py"), std::filesystem::perms::owner_all);
  std::ofstream(file("case.yaml")) << "base: " << TETHER_SOURCE << "/docs/examples/ring_tube.yaml\n"
                                   << "coupling: {ranks: {solid: 2}, programs: {solid: ./solid.py}}\n";
  Environment environment = python_path;
  environment["TETHER_STOPPED_LIMIT"] = "4";
  return run_job({product_program("tether"), "simulate", file("case.yaml"), "--output", file("out")}, environment);
}

TEST_F(ForeignPython, One_of_several_processes_that_dies_is_told) {
  const auto job = run_with_signal_in_second("SIGKILL");
  EXPECT_EQ(job.exit_code, 1) << job.output;
  EXPECT_NE(job.errors.find("ended: process 2 of 2 of solid (pid "), std::string::npos) << job.errors;
  EXPECT_NE(job.errors.find("died while "), std::string::npos) << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

/// Not by Python's own account of where it was.
TEST_F(ForeignPython, One_of_several_processes_that_is_interrupted_is_told) {
  const auto job = run_with_signal_in_second("SIGINT");
  EXPECT_EQ(job.exit_code, 1) << job.output;
  EXPECT_NE(job.errors.find("ended: process 2 of 2 of solid (pid "), std::string::npos) << job.errors;
  EXPECT_EQ(job.errors.find("Traceback"), std::string::npos) << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

TEST_F(ForeignPython, One_of_several_processes_that_is_stopped_is_told) {
  const auto job = run_with_signal_in_second("SIGSTOP");
  EXPECT_EQ(job.exit_code, 1) << job.output;
  EXPECT_NE(job.errors.find("solid: process 2 of 2 of solid (pid "), std::string::npos) << job.errors;
  EXPECT_NE(job.errors.find("and still is 4 s later"), std::string::npos) << job.errors;
  EXPECT_TRUE(job.orphans.empty());
}

TEST(Foreign, The_conformance_check_reports_a_death) {
  const auto job = run_job({product_program("tether_conform"), test_program("fake_solid")},
                           {{"TETHER_FAKE", "solid.kill=SolidTangent"}});
  EXPECT_EQ(job.exit_code, 1);
  EXPECT_NE(job.output.find("FAIL  tangent is the derivative of the evaluation       solid (pid "), std::string::npos)
      << job.output;
  EXPECT_TRUE(job.orphans.empty());
}

/// What is said of a solid that fails in that way, and its exit code.
void expect_failure(const std::string& in, int exit_code, const std::string& said) {
  Environment environment = python_path;
  environment["FAIL_IN"] = in;
  const std::string solid = std::string(TETHER_SOURCE) + "/tests/fakes/failing_solid.py";
  const auto job = run_job({test_program("fake_master"), "fake_fluid", solid, "3"}, environment);
  EXPECT_EQ(job.exit_code, exit_code);
  EXPECT_EQ(job.errors, "fake_master: solid" + said + "\n");
  EXPECT_TRUE(job.orphans.empty());
}

TEST_F(ForeignPython, Exceptions_are_reported_by_the_master) {
  expect_failure("set-up", 2, ": ValueError: case.yaml:3: no such mesh (failing_solid.py:17)");
  expect_failure(
      "evaluate", 1,
      " failed while computing step 0 (SolidEvaluate): RuntimeError: did not converge (failing_solid.py:31)");
}

TEST_F(ForeignPython, What_is_not_as_it_should_be_is_told_with_what_is_due) {
  expect_failure("parameters", 2, ": ValueError: parameters: {'name': 'stiffness'}: needs a name and a value");
  expect_failure("shape", 1,
                 " failed while computing step 0 (SolidEvaluate): ValueError: evaluate returned an array of shape (18, "
                 "2) and an array of shape (18, 3): 2 of shape (18, 3) are due");
  expect_failure("order", 1,
                 " failed while computing step 0 (SolidEvaluate): ValueError: evaluate returned an array of shape (3, "
                 "18) and an array of shape (3, 18): 2 of shape (18, 3) are due");
  expect_failure("count", 1,
                 " failed while computing step 0 (SolidEvaluate): ValueError: evaluate returned an array of shape (18, "
                 "3): 2 of shape (18, 3) are due");
}

}  // namespace
}  // namespace tether::tests
