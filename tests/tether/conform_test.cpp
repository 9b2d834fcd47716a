#include "tether/conform/conform.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fakes/fake_fluid.hpp"
#include "tests/fakes/fake_solid.hpp"
#include "tests/protocol/in_process.hpp"

/// The conformance check passes the fakes, and finds each single fault at the right check and nowhere else.
namespace tether::protocol {
namespace {

std::vector<std::string> failures(const std::vector<Check>& checks) {
  std::vector<std::string> names;
  for (const Check& check : checks)
    if (check.result == Check::Result::failed) names.push_back(check.name);
  return names;
}

template <class Requests, class Fake>
std::vector<std::string> faults_of(const std::string& role, Fake fake) {
  Partner partner = in_process_partner<Requests>(role, std::make_shared<Fake>(std::move(fake)));
  return failures(conform(partner, 1e-3));
}

using Names = std::vector<std::string>;

TEST(Conform, Passes_the_fakes_whatever_they_announce) {
  for (const bool all : {true, false}) {
    fakes::FakeSolid solid;
    solid.has_tangent = solid.has_operators = solid.has_state = all;
    EXPECT_EQ(faults_of<ToSolid>("solid", solid), Names{});
    fakes::FakeFluid fluid;
    fluid.has_tangent = fluid.has_state = all;
    EXPECT_EQ(faults_of<ToFluid>("fluid", fluid), Names{});
  }
}

TEST(Conform, Finds_normals_that_look_inward) {
  fakes::FakeSolid solid;
  for (std::size_t t = 0; t < solid.surface.triangles.size(); t += 3)
    std::swap(solid.surface.triangles[t], solid.surface.triangles[t + 1]);
  EXPECT_EQ(faults_of<ToSolid>("solid", solid), Names{"normals point out of the fluid"});
}

TEST(Conform, Finds_one_triangle_turned_over) {
  fakes::FakeSolid solid;
  std::swap(solid.surface.triangles[0], solid.surface.triangles[1]);
  EXPECT_EQ(faults_of<ToSolid>("solid", solid), Names{"normals point out of the fluid"});
}

TEST(Conform, Finds_a_node_without_triangle_and_stops_there) {
  fakes::FakeSolid solid;
  solid.surface.points.insert(solid.surface.points.end(), {9, 9, 9});
  solid.y0.resize(57), solid.u0.resize(57), solid.v.resize(57);
  EXPECT_EQ(faults_of<ToSolid>("solid", solid), Names{"interface is a surface"});
}

struct WrongTangent : fakes::FakeSolid {
  using FakeSolid::operator();
  Motion operator()(const SolidTangent& m) {
    Motion change = FakeSolid::operator()(m);
    change.velocity[0] *= 1.05;
    return change;
  }
};

struct ForgetfulState : fakes::FakeSolid {
  using FakeSolid::operator();
  Ready operator()(const SetState& m) {  // keeps the velocity it had
    const auto kept = u0;
    FakeSolid::operator()(m);
    u0 = kept;
    return {};
  }
};

struct NoRewind : fakes::FakeSolid {
  using FakeSolid::operator();
  StepReport operator()(const EndStep&) { return FakeSolid::operator()(EndStep{true}); }
};

struct Drifting : fakes::FakeFluid {
  using FakeFluid::operator();
  double drift = 0;
  Load operator()(const FluidEvaluate& m) {
    Load load = FakeFluid::operator()(m);
    load.forces[0] += drift += 1e-3;
    return load;
  }
};

struct Asymmetric : fakes::FakeSolid {
  using FakeSolid::operator();
  Unknowns operator()(const SolidPrecondition& m) {
    Unknowns result = FakeSolid::operator()(m);
    result.values[0] += 1e-3 * result.values[1];
    return result;
  }
};

struct Credulous : fakes::FakeFluid {
  using FakeFluid::operator();
  Ready operator()(const SetParameters&) { return {}; }
};

/// Sets names one after the other until it finds one that it does not know.
struct HalfWay : fakes::FakeFluid {
  using FakeFluid::operator();
  Ready operator()(const SetParameters& m) {
    for (std::size_t i = 0; i < m.names.size(); ++i) FakeFluid::operator()(SetParameters{{m.names[i]}, {m.values[i]}});
    return {};
  }
};

/// Accepts known names, and goes on as before.
struct Deaf : fakes::FakeFluid {
  using FakeFluid::operator();
  Ready operator()(const SetParameters& m) {
    Deaf other = *this;
    return static_cast<FakeFluid&>(other)(m);
  }
};

struct WithoutVelocity : fakes::FakeFluid {
  using FakeFluid::operator();
  Velocity operator()(const GetVelocity&) { throw run_error("cannot interpolate"); }
  Ready operator()(const MoveInterface&) { return {}; }
};

TEST(Conform, Finds_a_wrong_tangent) {
  EXPECT_EQ(faults_of<ToSolid>("solid", WrongTangent{}), Names{"tangent is the derivative of the evaluation"});
}

TEST(Conform, Finds_an_incomplete_state) {
  EXPECT_EQ(faults_of<ToSolid>("solid", ForgetfulState{}), Names{"a state set again continues bit for bit"});
}

TEST(Conform, Finds_a_step_that_is_not_taken_back) {
  const Names found = faults_of<ToSolid>("solid", NoRewind{});
  EXPECT_NE(std::find(found.begin(), found.end(), "a rejected step leaves no trace"), found.end());
}

TEST(Conform, Finds_an_evaluation_that_depends_on_the_one_before) {
  const Names found = faults_of<ToFluid>("fluid", Drifting{});
  EXPECT_NE(std::find(found.begin(), found.end(), "the same evaluation again gives the same"), found.end());
}

TEST(Conform, Finds_an_asymmetric_preconditioner) {
  EXPECT_EQ(faults_of<ToSolid>("solid", Asymmetric{}), Names{"operators are symmetric"});
}

TEST(Conform, Finds_that_unknown_parameters_are_swallowed) {
  EXPECT_EQ(faults_of<ToFluid>("fluid", Credulous{}), Names{"parameters can be set, unknown ones are refused"});
}

TEST(Conform, Finds_that_parameters_do_nothing) {
  EXPECT_EQ(faults_of<ToFluid>("fluid", Deaf{}), Names{"parameters can be set, unknown ones are refused"});
}

TEST(Conform, Finds_that_known_parameters_are_set_beside_an_unknown_one) {
  EXPECT_EQ(faults_of<ToFluid>("fluid", HalfWay{}), Names{"parameters can be set, unknown ones are refused"});
}

TEST(Conform, A_fluid_that_announces_its_velocity_and_fails_to_tell_it_is_at_fault) {
  WithoutVelocity fluid;
  EXPECT_EQ(faults_of<ToObservedFluid>("fluid", fluid), Names{});
  fluid.has_velocity = true;
  EXPECT_EQ(faults_of<ToObservedFluid>("fluid", fluid), Names{"tells its velocity inside, and none outside"});
}

}  // namespace
}  // namespace tether::protocol
