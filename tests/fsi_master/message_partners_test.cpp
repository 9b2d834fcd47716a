#include "fsi_master/message_partners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fakes/fake_fluid.hpp"
#include "tests/fakes/fake_solid.hpp"
#include "tests/protocol/in_process.hpp"

namespace tether {
namespace {

using protocol::in_process_partner;

/// The fake fluid, its nodes numbered backwards: its added mass does not change by that.
fakes::FakeFluid backwards() {
  fakes::FakeFluid fluid;
  Points points = Eigen::Map<Points>(fluid.surface.points.data(), 3, static_cast<Eigen::Index>(fluid.size() / 3));
  points = points.rowwise().reverse().eval();
  std::copy(points.data(), points.data() + points.size(), fluid.surface.points.begin());
  return fluid;
}

VectorXd load_of(const fakes::FakeFluid& fake, const VectorXd& V) {
  auto process = in_process_partner<protocol::ToFluid>("fluid", std::make_shared<fakes::FakeFluid>(fake));
  auto solid_process = in_process_partner<protocol::ToSolid>("solid", std::make_shared<fakes::FakeSolid>());
  MessageFluid fluid(
      process, InterfaceMap::match(ask_interface(process), ask_interface(solid_process), 1e-9, UnitSystem::cgs()));
  fluid.begin_step({1, 0, 0.1, V, V}).get();
  return fluid.load({V, V}).get();
}

TEST(MessageFluid, SpeaksInTheSolidsOrderOfNodes) {
  const auto size = static_cast<Eigen::Index>(fakes::FakeFluid().size());
  VectorXd V = VectorXd::LinSpaced(size, 0, 1).array().sin();
  EXPECT_LT((load_of(backwards(), V) - load_of({}, V)).norm(), 1e-14);
}

TEST(MessagePartners, AFailureIsAStepFailureAndTheNextRequestGetsItsOwnReply) {
  auto fake = std::make_shared<fakes::FakeFluid>();
  fake->has_tangent = false;
  auto without_tangent = in_process_partner<protocol::ToFluid>("fluid", fake);
  const InterfaceSurface surface = ask_interface(without_tangent);
  MessageFluid black_box(without_tangent, InterfaceMap::match(surface, surface, 1e-9, UnitSystem::cgs()));
  EXPECT_FALSE(black_box.has_tangent());
  EXPECT_THROW(black_box.load_change(VectorXd::Zero(surface.points.size())).get(), StepFailure);
  { auto dropped = black_box.state(); }
  EXPECT_EQ(black_box.end_step(true).get().size(), 1u);
}

/// A displacement of which one number is none, and a state of another size than announced.
struct Careless : fakes::FakeSolid {
  using FakeSolid::operator();
  protocol::Motion operator()(const protocol::SolidEvaluate& m) {
    protocol::Motion motion = FakeSolid::operator()(m);
    motion.displacement[7] = displacement;
    return motion;
  }
  protocol::State operator()(const protocol::GetState& m) {
    protocol::State state = FakeSolid::operator()(m);
    (short_state ? state.values.pop_back() : void(state.values[0] = std::nan("")));
    return state;
  }
  bool short_state = false;
  double displacement = std::nan("");
};

TEST(MessageSolid, ADisplacementThatIsNoNumberFailsTheStep) {
  auto process = in_process_partner<protocol::ToSolid>("solid", std::make_shared<Careless>());
  MessageSolid solid(process);
  const VectorXd zero = VectorXd::Zero(ask_interface(process).points.size());
  solid.begin_step({1, 0, 0.1, zero, zero}).get();
  try {
    solid.motion(zero).get();
    FAIL() << "no error";
  } catch (const StepFailure& failure) {
    EXPECT_STREQ(failure.what(), "solid answered with a displacement that is not finite, at interface node 2");
  }
}

/// 1e300 is a number, and would be saved.
TEST(MessageSolid, ADisplacementThatNoWallHasFailsTheStep) {
  auto careless = std::make_shared<Careless>();
  auto process = in_process_partner<protocol::ToSolid>("solid", careless);
  MessageSolid solid(process, 2);
  const VectorXd zero = VectorXd::Zero(ask_interface(process).points.size());
  careless->displacement = 19;
  solid.begin_step({1, 0, 0.1, zero, zero}).get();
  EXPECT_EQ(solid.motion(zero).get().displacement[7], 19);
  careless->displacement = -1e300;
  try {
    solid.motion(zero).get();
    FAIL() << "no error";
  } catch (const StepFailure& failure) {
    EXPECT_STREQ(failure.what(),
                 "solid answered with a displacement of -1e+300 at interface node 2: more than 10 times the size of "
                 "the interface, 2");
  }
}

TEST(MessageSolid, AStateThatCannotBeSetAgainIsRefusedBeforeItIsSaved) {
  const auto said = [](bool is_short) -> std::string {
    auto careless = std::make_shared<Careless>();
    careless->short_state = is_short;
    auto process = in_process_partner<protocol::ToSolid>("solid", careless);
    process.hello();
    try {
      MessageSolid(process).state().get();
    } catch (const RunError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(said(true).find(" numbers after announcing "), std::string::npos) << said(true);
  EXPECT_EQ(said(false), "solid gives a state with numbers that are not finite");
}

/// Its observable is no number.
struct Unknowing : fakes::FakeFluid {
  using FakeFluid::operator();
  protocol::StepReport operator()(const protocol::EndStep& m) {
    FakeFluid::operator()(m);
    return {{std::nan("")}};
  }
};

TEST(MessageFluid, AnObservableThatIsNoNumberIsRefusedOfAStepThatWasAccepted) {
  auto process = in_process_partner<protocol::ToFluid>("fluid", std::make_shared<Unknowing>());
  const InterfaceSurface surface = ask_interface(process);
  MessageFluid fluid(process, InterfaceMap::match(surface, surface, 1e-9, UnitSystem::cgs()));
  EXPECT_TRUE(std::isnan(fluid.end_step(false).get().at(0)));
  try {
    fluid.end_step(true).get();
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(), "fluid reports pressure.now as nan after a step that was accepted");
  }
}

TEST(MessageSolid, GivesItsEquationsAsTheSolidSentThem) {
  auto process = in_process_partner<protocol::ToSolid>("solid", std::make_shared<fakes::FakeSolid>());
  MessageSolid solid(process);
  const Eigen::Index size = ask_interface(process).points.size();
  const VectorXd zero = VectorXd::Zero(size), load = VectorXd::Constant(size, 2.0);
  solid.begin_step({1, 0, 0.1, zero, zero}).get();
  EXPECT_EQ(solid.residual({}, load).get().residual, load);  // at rest nothing else acts
  const VectorXd V = solid.motion(load).get().velocity;      // m/dt + c + k dt = 10 + 2 + 5
  EXPECT_LT((V - load / 17).norm(), 1e-14);
  EXPECT_LT((solid.product(V).get() - load).norm(), 1e-13);
  EXPECT_LT((solid.precondition(load).get() - V).norm(), 1e-14);
}

}  // namespace
}  // namespace tether
