#include <mpi.h>

#include "common/protocol/run.hpp"
#include "tests/fakes/fake_solid.hpp"
#include "tests/fakes/misbehave.hpp"

using namespace tether;

/// A machine so busy that this process takes leave late.
extern "C" int MPI_Comm_disconnect(MPI_Comm* communicator) {
  fakes::misbehave("solid", "leave");
  return PMPI_Comm_disconnect(communicator);
}

int main() {
  fakes::misbehave("solid", "start");
  return protocol::run_partner<protocol::ToSolid>("solid", [](const protocol::Welcome&) {
    fakes::misbehave("solid", "hello");
    fakes::FakeSolid solid;
    solid.has_tangent = fakes::option("solid", "tangent") != "no";
    solid.has_operators = fakes::option("solid", "operators") != "no";
    solid.has_state = fakes::option("solid", "state") != "no";
    solid.is_outside = fakes::option("solid", "announce") == "outside";
    solid.announces_twice = fakes::option("solid", "announce") == "twice";
    return fakes::Misbehaving<fakes::FakeSolid>("solid", solid);
  });
}
