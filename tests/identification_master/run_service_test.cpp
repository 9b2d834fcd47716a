/// Runs for whoever asks, by a fake of the groups that make them.
#include "identification_master/run_service.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

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
    busy.emplace_back(group, run);
    begun.push_back(run);
  }
  End next() override {
    const auto [group, run] = busy.back();
    busy.pop_back();
    return {group, {run.values[0] == 9 ? "too much" : "", 40}, 0.5};
  }
};

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
  RunService later(makers, "abc", 20);
  const auto again = made(later, {order("a", 3), order("b", 9), order("c", 5)});
  EXPECT_FALSE(again[0].made);
  EXPECT_EQ(again[0].cpu_seconds, 0);
  EXPECT_EQ(again[1].failure, "too much");
  EXPECT_TRUE(again[2].made);
  EXPECT_EQ(makers.begun.size(), 3U);
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

TEST_F(Service, RefusesWhatTheModelDoesNotHave) {
  EXPECT_EQ(message_of([&] {
              service(protocol::OrderRuns{{{"x", {"solid.colour"}, {1}}}, {}});
            }),
            "x: the model has no number solid.colour");
  EXPECT_EQ(message_of([&] { service(protocol::NextRun{}); }), "no run is under way");
}

}  // namespace run_service_test
}  // namespace tether
