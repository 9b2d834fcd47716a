#include "fsi_master/message_partners.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
  MessageFluid fluid(process, InterfaceMap::match(ask_interface(process), ask_interface(solid_process), 1e-9));
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
  MessageFluid black_box(without_tangent, InterfaceMap::match(surface, surface, 1e-9));
  EXPECT_FALSE(black_box.has_tangent());
  EXPECT_THROW(black_box.load_change(VectorXd::Zero(surface.points.size())).get(), StepFailure);
  { auto dropped = black_box.state(); }
  EXPECT_EQ(black_box.end_step(true).get().size(), 1u);
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
