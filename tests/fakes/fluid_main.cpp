#include "common/protocol/run.hpp"
#include "tests/fakes/fake_fluid.hpp"
#include "tests/fakes/misbehave.hpp"

using namespace tether;

int main() {
  fakes::misbehave("fluid", "start");
  return protocol::run_partner<protocol::ToFluid>("fluid", [](const protocol::Welcome&) {
    fakes::misbehave("fluid", "hello");
    fakes::FakeFluid fluid;
    fluid.has_tangent = fakes::option("fluid", "tangent") != "no";
    fluid.has_state = fakes::option("fluid", "state") != "no";
    return fakes::Misbehaving<fakes::FakeFluid>("fluid", fluid);
  });
}
