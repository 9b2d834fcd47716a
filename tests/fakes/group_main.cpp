#include "common/protocol/run.hpp"
#include "tests/fakes/misbehave.hpp"

using namespace tether;
using namespace tether::protocol;

namespace {

/// A partner that is a master itself: for each question it asks its own fluid and solid.
struct Group {
  std::span<Partner> partners;
  std::int64_t step = 0;

  Hello hello() const {
    Hello hello;
    hello.program = "fake group";
    return hello;
  }
  Ready operator()(const SetParameters&) { return {}; }
  Ready operator()(const Write&) { return {}; }
  Ready operator()(const Stop&) { return {}; }
  Discrepancy operator()(const Observe& m) {
    fakes::misbehave("fsi_master", "Observe");
    const std::vector<double> rest(m.points.size());
    for (Partner& partner : partners) partner.ask(BeginStep{step, m.time, 0.01, rest});
    const Load load = partners[0].ask(FluidEvaluate{rest, rest});
    const Motion motion = partners[1].ask(SolidEvaluate{load.forces});
    for (Partner& partner : partners) partner.ask(EndStep{true});
    ++step;
    Discrepancy reply;
    reply.distances = motion.displacement;
    return reply;
  }
};

}  // namespace

int main() {
  return run_partner<ToObservation>("fsi_master", [](const Welcome& welcome, Session& session) {
    Group group{session.launch({{"fluid", "fake_fluid", {}}, {"solid", "fake_solid", {}}}, welcome.output)};
    for (Partner& partner : group.partners) partner.hello();
    return group;
  });
}
