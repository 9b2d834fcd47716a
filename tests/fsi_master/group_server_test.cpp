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
  GroupServer group{std::make_unique<MasterCase>(folder.file("case.yaml",
                                                             "name: fake\nunits: cgs\n"
                                                             "time: {step: 0.01, end: 0.08}\n")),
                    {},
                    processes};

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

}  // namespace
}  // namespace tether
