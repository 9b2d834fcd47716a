/// Runs for whoever asks, by a fake of the groups that make them.
#include "identification_master/run_service.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "common/io/lumen_motion.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace run_service_test {

/// Two groups; the one that began last ends first. A stiffness of 9 is too much.
struct FakeMakers : RunMakers {
  protocol::Hello hello;
  std::vector<std::pair<std::size_t, protocol::Simulate>> busy;
  std::vector<protocol::Simulate> begun;

  FakeMakers() { hello.parameters = {{"solid.stiffness", "", "", "log", 1}, {"fluid.density", "", "", "log", 2}}; }
  const protocol::Hello& model() const override { return hello; }
  std::size_t groups() const override { return 2; }
  void begin(std::size_t group, const protocol::Simulate& run) override {
    std::filesystem::create_directories(run.output);
    LumenMotionWriter motion(std::filesystem::path(run.output) / "lumen.motion", Points::Zero(3, 2));
    motion.start();
    std::ofstream table(std::filesystem::path(run.output) / "timeseries.csv");
    table << "time [s]\n";
    for (int step = 0; step <= run.steps; ++step) {
      motion.append(0.1 * step, Points::Ones(3, 2));
      table << 0.1 * step << "\n";
    }
    busy.emplace_back(group, run);
    begun.push_back(run);
  }
  End next() override {
    const auto [group, run] = busy.back();
    busy.pop_back();
    return {group, {run.values[0] == 9 ? "too much" : "", 40}, 0.5};
  }
};

std::string content_of(const std::filesystem::path& file) {
  std::ifstream from(file);
  return {std::istreambuf_iterator<char>(from), {}};
}

class Service : public ::testing::Test {
 protected:
  protocol::RunOrder order(const std::string& name, double stiffness) const {
    return {(folder / name).string(), {"solid.stiffness"}, {stiffness}};
  }
  std::vector<protocol::RunEnded> made(RunService& of, const std::vector<protocol::RunOrder>& orders) const {
    of(protocol::OrderRuns{orders, "guide"});
    std::vector<protocol::RunEnded> all;
    for (std::size_t k = 0; k < orders.size(); ++k) all.push_back(of(protocol::NextRun{}));
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.folder < b.folder; });
    return all;
  }

  TemporaryFolder folder;
  FakeMakers makers;
  RunService service{makers, "abc", 20};
};

TEST_F(Service, DealsRunsToGroupsThatAreFree) {
  const auto ended = made(service, {order("a", 3), order("b", 9), order("c", 5)});
  ASSERT_EQ(ended.size(), 3U);
  EXPECT_EQ(ended[0].folder, (folder / "a").string());
  EXPECT_EQ(ended[0].failure, "");
  EXPECT_EQ(ended[1].failure, "too much");
  EXPECT_TRUE(ended[2].made);
  EXPECT_EQ(ended[2].evaluations, 40);
  EXPECT_EQ(ended[2].cpu_seconds, 0.5);
  ASSERT_EQ(makers.begun.size(), 3U);
  EXPECT_EQ(makers.begun[0].values, (std::vector<double>{3, 2})) << "all numbers are told";
  EXPECT_EQ(makers.begun[0].steps, 20);
  EXPECT_EQ(makers.begun[0].guide, "guide");
}

TEST_F(Service, MakesNoRunTwice) {
  made(service, {order("a", 3), order("b", 9)});
  const auto failed = made(service, {order("b", 9)});
  EXPECT_FALSE(failed[0].made);
  EXPECT_EQ(failed[0].failure, "too much");
  RunService later(makers, "abc", 20);
  const auto again = made(later, {order("a", 3), order("c", 5)});
  EXPECT_FALSE(again[0].made);
  EXPECT_EQ(again[0].cpu_seconds, 0);
  EXPECT_TRUE(again[1].made);
  EXPECT_EQ(makers.begun.size(), 3U);
}

/// Who calls again may have mended what the run lacked: a licence, a file, memory.
TEST_F(Service, MakesAgainWhatFailedUnderAnother) {
  const TemporaryFolder store;
  RunService sharing(makers, "abc", 20, RunStore(store.path(), "programs"));
  made(sharing, {order("a", 9)});
  RunService later(makers, "abc", 20, RunStore(store.path(), "programs"));
  EXPECT_TRUE(made(later, {order("a", 9)})[0].made);
  EXPECT_TRUE(made(later, {order("b", 9)})[0].made) << "a failure is not shared";
  EXPECT_FALSE(made(later, {order("b", 9)})[0].made);
}

TEST_F(Service, AnotherCaseOtherValuesOrStepsAreAnotherRun) {
  made(service, {order("a", 3)});
  EXPECT_TRUE(made(service, {order("a", 4)})[0].made);
  RunService other_case(makers, "abd", 20), longer(makers, "abd", 30);
  EXPECT_TRUE(made(other_case, {order("a", 4)})[0].made);
  EXPECT_TRUE(made(longer, {order("a", 4)})[0].made);
  EXPECT_FALSE(made(longer, {order("a", 4)})[0].made);
  std::ofstream(folder / "a/run.json") << "{\"case\": 17}";
  EXPECT_TRUE(made(longer, {order("a", 4)})[0].made) << "a file of another version";
}

TEST_F(Service, ARunWhoseTableIsNotAsItWasIsAnotherRun) {
  MadeRun run;
  run.failure = "so that no motion is wanted";
  std::filesystem::create_directories(folder / "a");
  std::ofstream(folder / "a/timeseries.csv") << "time [s]\n0.1\n";
  write_made_run(folder / "a", run);
  EXPECT_TRUE(made_run_in(folder / "a"));
  std::ofstream(folder / "a/timeseries.csv") << "time [s]\n0.2\n";
  EXPECT_FALSE(made_run_in(folder / "a"));
  std::filesystem::remove(folder / "a/timeseries.csv");
  EXPECT_FALSE(made_run_in(folder / "a"));
}

/// Each record has a checksum, which that of another run has too.
TEST_F(Service, ARunWithTheMotionOfAnotherIsAnotherRun) {
  MadeRun run;
  run.failure = "so that no steps are wanted";
  std::filesystem::create_directories(folder / "a");
  const auto move = [&](double displacement) {
    LumenMotionWriter motion(folder / "a/lumen.motion", Points::Zero(3, 2));
    motion.start();
    motion.append(0, Points::Constant(3, 2, displacement));
  };
  move(1);
  write_made_run(folder / "a", run);
  EXPECT_TRUE(made_run_in(folder / "a"));
  move(2);
  EXPECT_FALSE(made_run_in(folder / "a"));
}

TEST_F(Service, SharesRunsByWhatTheyDependOn) {
  const RunStore store(folder / "shared", "1");
  RunService first(makers, "abc", 20, store), second(makers, "abc", 20, store);
  EXPECT_TRUE(made(first, {order("one/a", 3)})[0].made);
  std::ofstream(folder / "one/a/mark") << "of 3";
  const auto lent = made(second, {order("two/b", 3)});
  EXPECT_FALSE(lent[0].made);
  EXPECT_EQ(lent[0].cpu_seconds, 0);
  EXPECT_EQ(content_of(folder / "two/b/mark"), "of 3");

  RunService other_model(makers, "abd", 20, store), other_steps(makers, "abc", 30, store);
  RunService other_solver(makers, "abc", 20, RunStore(folder / "shared", "2"));
  EXPECT_TRUE(made(second, {order("two/b", 4)})[0].made) << "another value in the place of a run that is lent";
  EXPECT_TRUE(made(other_model, {order("three/b", 3)})[0].made);
  EXPECT_TRUE(made(other_steps, {order("four/b", 3)})[0].made);
  EXPECT_TRUE(made(other_solver, {order("five/b", 3)})[0].made);
  EXPECT_EQ(content_of(folder / "one/a/mark"), "of 3");
  EXPECT_FALSE(made(first, {order("one/a", 3)})[0].made);
}

TEST_F(Service, TwoThatMakeTheSameRunKeepTheFirst) {
  const RunStore store(folder / "shared", "1");
  RunService first(makers, "abc", 20, store);
  FakeMakers others;
  RunService second(others, "abc", 20, store);
  first(protocol::OrderRuns{{order("one/a", 3)}, ""});
  second(protocol::OrderRuns{{order("two/a", 3)}, ""});
  std::ofstream(folder / "one/a/mark") << "of the first";
  std::ofstream(folder / "two/a/mark") << "of the second";
  EXPECT_TRUE(first(protocol::NextRun{}).made);
  EXPECT_TRUE(second(protocol::NextRun{}).made);
  for (const char* name : {"one/a", "two/a"}) EXPECT_EQ(content_of(folder / name / "mark"), "of the first");
}

TEST_F(Service, GivesItsOwnRunsToThoseThatAreShared) {
  made(service, {order("one/a", 3), order("one/b", 5)});
  const RunStore store(folder / "shared", "1");
  RunService again(makers, "abc", 20, store), other(makers, "abc", 20, store);
  EXPECT_FALSE(made(again, {order("one/a", 3), order("one/b", 5)})[1].made);
  std::filesystem::remove_all(folder / "one");
  const auto lent = made(other, {order("two/a", 3), order("two/b", 5)});
  EXPECT_FALSE(lent[0].made);
  EXPECT_FALSE(lent[1].made);
}

TEST_F(Service, MakesAgainWhatWasDeletedFromThoseThatAreShared) {
  const RunStore store(folder / "shared", "1");
  RunService first(makers, "abc", 20, store);
  made(first, {order("one/a", 3)});
  std::filesystem::remove_all(folder / "shared");
  EXPECT_TRUE(made(first, {order("one/a", 3)})[0].made);
  EXPECT_TRUE(std::filesystem::exists(folder / "one/a/run.json"));
}

TEST_F(Service, MakesAgainWhatIsDamaged) {
  const RunStore store(folder / "shared", "1");
  RunService first(makers, "abc", 20, store), second(makers, "abc", 20, store);
  made(first, {order("one/a", 3)});
  const auto motion = folder / "one/a/lumen.motion";
  std::filesystem::resize_file(motion, std::filesystem::file_size(motion) - 1);
  EXPECT_TRUE(made(second, {order("two/a", 3)})[0].made) << "not lent";
  EXPECT_FALSE(made(first, {order("one/a", 3)})[0].made) << "made for the second, and whole";
  EXPECT_EQ(LumenMotion(motion).times().size(), 21U);
  std::ofstream(folder / "two/a/timeseries.csv") << "time [s]\n0\n";
  EXPECT_TRUE(made(first, {order("one/a", 3)})[0].made);
}

TEST_F(Service, RefusesWhatTheModelDoesNotHave) {
  EXPECT_EQ(message_of([&] {
              service(protocol::OrderRuns{{{"x", {"solid.colour"}, {1}}}, {}});
            }),
            "x: the model has no number solid.colour");
  EXPECT_EQ(message_of([&] { service(protocol::NextRun{}); }), "no run is under way");
}

}  // namespace run_service_test
}  // namespace tether
