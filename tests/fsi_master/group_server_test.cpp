#include "fsi_master/group_server.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "tests/fakes/fake_fluid.hpp"
#include "tests/fakes/fake_solid.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/protocol/in_process.hpp"

namespace tether {
namespace {

struct FirmSolid : fakes::FakeSolid {
  using FakeSolid::operator();
  protocol::Ready operator()(const protocol::SetParameters& m) {
    for (const double value : m.values)
      if (value < 0) throw input_error("parameter stiffness: {} is out of its range", value);
    return FakeSolid::operator()(m);
  }
};

class Group : public ::testing::Test {
 protected:
  TemporaryFolder folder;
  std::shared_ptr<fakes::FakeFluid> fluid = std::make_shared<fakes::FakeFluid>();
  std::shared_ptr<FirmSolid> solid = std::make_shared<FirmSolid>();
  std::vector<protocol::Partner> processes = partners();
  GroupServer group = group_of("");

  GroupServer group_of(const std::string& more) {
    const std::string text = "name: fake\nunits: cgs\ntime: {step: 0.01, end: 0.08}\n" + more;
    return {std::make_unique<MasterCase>(folder.file("case.yaml", text)), {}, processes};
  }
  /// The output of a run of this vessel, after two steps of which the fluid knows the time.
  void save(const Checkpoint& checkpoint) const {
    std::filesystem::create_directory(folder / "run");
    write_checkpoint(folder / "run", checkpoint);
  }
  Checkpoint state_at(double time, double displacement) const {
    const std::vector<double> all(solid->y0.size(), displacement), none(solid->y0.size(), 0.0);
    std::vector<double> of_solid = all;
    of_solid.insert(of_solid.end(), none.begin(), none.end());
    const Points interface = Eigen::Map<const Points>(solid->surface.points.data(), 3,
                                                      static_cast<Eigen::Index>(solid->surface.points.size() / 3));
    const StateOrigin origin = origin_of(CaseFile(folder / "case.yaml"), interface, 1);
    return {2, 0, {{time}, of_solid, all, none, "newton_krylov", {}}, {}, "", "", origin};
  }

 private:
  std::vector<protocol::Partner> partners() const {
    std::vector<protocol::Partner> both;
    both.push_back(protocol::in_process_partner<protocol::ToFluid>("fluid", fluid));
    both.push_back(protocol::in_process_partner<protocol::ToSolid>("solid", solid));
    return both;
  }
};

TEST_F(Group, SetsParametersOfBothCodes) {
  group(protocol::SetParameters{{"solid.stiffness", "fluid.pressure"}, {60, 4}});
  EXPECT_EQ(solid->stiffness, 60);
  EXPECT_EQ(fluid->pressure, 4);
}

TEST_F(Group, AnUnknownNameChangesNothingBeforeOrAfterIt) {
  EXPECT_THROW(group(protocol::SetParameters{{"fluid.pressure", "fluid.colour"}, {4, 1}}), InputError);
  EXPECT_THROW(group(protocol::SetParameters{{"fluid.colour", "solid.stiffness"}, {1, 60}}), InputError);
  EXPECT_EQ(fluid->pressure, 3);
  EXPECT_EQ(solid->stiffness, 50);
}

TEST_F(Group, WhatTheSolidRefusesLeavesTheFluidAsItWas) {
  group(protocol::SetParameters{{"fluid.pressure"}, {4}});
  EXPECT_THROW(group(protocol::SetParameters{{"fluid.pressure", "solid.stiffness"}, {5, -1}}), InputError);
  EXPECT_EQ(fluid->pressure, 4);
  EXPECT_EQ(fluid->added_mass, 0.5);
  EXPECT_EQ(solid->stiffness, 50);
}

TEST_F(Group, BeginsItsParticlesAndRunsWithTheStateThatTheCaseNames) {
  save(state_at(0.02, 0.5));
  GroupServer begun = group_of("initial_state: {from: run}\n");
  EXPECT_EQ(fluid->time, 0.02);
  EXPECT_EQ(solid->y0, std::vector<double>(solid->y0.size(), 0.5));
  EXPECT_EQ(begun(protocol::GetState{}).values.front(), 0.02);
  ASSERT_EQ(begun.hello().notices.size(), 1U);
  EXPECT_NE(begun.hello().notices[0].find("after 2 steps"), std::string::npos) << begun.hello().notices[0];

  const std::string model = begun.hello().effective_case;
  EXPECT_NE(model, group.hello().effective_case) << "runs that begin elsewhere are others";
  solid->y0.assign(solid->y0.size(), 0.0);
  begun(protocol::Simulate{{}, {}, 1, (folder / "whole").string(), ""});
  const LumenMotion motion(folder / "whole/lumen.motion");
  EXPECT_NEAR((motion.at(0) - motion.imaged()).minCoeff(), 0.5, 1e-6) << "a whole run too";
  EXPECT_EQ(solid->y0, std::vector<double>(solid->y0.size(), 0.5)) << "and the group is back there";

  save(state_at(0.02, 0.25));
  EXPECT_NE(group_of("initial_state: {from: run}\n").hello().effective_case, model) << "as do those of another state";
}

TEST_F(Group, RefusesAStateOfAnotherLumen) {
  Checkpoint other = state_at(0.02, 0.5);
  other.origin.nodes += 1;
  save(other);
  EXPECT_THROW(group_of("initial_state: {from: run}\n"), InputError);
  other = state_at(0.02, 0.5);
  other.snapshot.solid.pop_back();
  save(other);
  EXPECT_NE(message_of([&] { group_of("initial_state: {from: run}\n"); }).find("a state has 107 entries"),
            std::string::npos);
}

/// What an identification writes into a case must not be lost on a code that does not read it there.
TEST_F(Group, RefusesANumberOfTheCaseThatAnothersCodeDoesNotRead) {
  const std::string theirs = "coupling: {programs: {solid: ./theirs}}\n";
  EXPECT_NE(message_of([&] {
              group_of(theirs + "solid: {stiffness: 60}\n");
            }).find("solid.stiffness: 60: fake solid 1 announces stiffness as 50"),
            std::string::npos);
  for (const char* fine : {"solid: {stiffness: 50}\n", "solid: {stiffness: 60 N/m}\n", "solid: {other: 60}\n"})
    EXPECT_NO_THROW(group_of(theirs + fine)) << fine;
}

/// The nodes of a wall of somebody else's come in an order of its own: what is told, and observed, is the fluid's.
TEST_F(Group, TellsOfTheFluidsNodesWhereTheWallIsAnothersCode) {
  protocol::Interface& theirs = solid->surface;
  const auto nodes = static_cast<std::int64_t>(theirs.points.size() / 3);
  for (std::int64_t node = 0; node < nodes / 2; ++node)
    std::swap_ranges(theirs.points.begin() + 3 * node, theirs.points.begin() + 3 * (node + 1),
                     theirs.points.begin() + 3 * (nodes - 1 - node));
  for (std::int64_t& node : theirs.triangles) node = nodes - 1 - node;
  save(state_at(0.02, 0));
  Checkpoint bent = state_at(0.02, 0);
  for (std::size_t i = 0; i < bent.snapshot.displacement.size(); ++i)
    bent.snapshot.displacement[i] = bent.snapshot.solid[i] = 1e-3 * theirs.points[i - i % 3 + 2];  // as far as along z
  save(bent);
  GroupServer told = group_of("initial_state: {from: run}\ncoupling: {programs: {solid: ./theirs}}\n");
  EXPECT_EQ(told(protocol::GetInterface{}).points, fluid->surface.points);

  const std::vector<double> state = told(protocol::GetState{}).values;
  const std::size_t size = fluid->surface.points.size();
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_DOUBLE_EQ(state[state.size() - 2 * size + i], 1e-3 * fluid->surface.points[i - i % 3 + 2]) << i;
  told(protocol::SetState{state});
  EXPECT_EQ(told(protocol::GetState{}).values, state);
  const auto refusal = [&](std::size_t length) {
    return message_of([&] { told(protocol::SetState{std::vector<double>(length)}); });
  };
  EXPECT_NE(refusal(state.size() - 1).find("too short"), std::string::npos);
  EXPECT_NE(refusal(state.size() + 1).find("too long"), std::string::npos);

  told(protocol::Simulate{{}, {}, 1, (folder / "whole").string(), ""});
  const LumenMotion motion(folder / "whole/lumen.motion");
  EXPECT_EQ(std::vector<double>(motion.imaged().data(), motion.imaged().data() + size), fluid->surface.points);
  const Points moved = motion.at(0) - motion.imaged();
  for (Eigen::Index k = 0; k < moved.cols(); ++k) EXPECT_NEAR(moved(0, k), 1e-3 * motion.imaged()(2, k), 1e-9);
}

}  // namespace
}  // namespace tether
