#include "fluid/application.hpp"
#include "fsi_master/application.hpp"
#include "solid/application.hpp"

/// With Tether's own codes in it: a group of an identification has them in its process.
int main(int argc, char** argv) {
  return tether::run_main(
      argc, argv,
      tether::fsi_master_program({{"fluid", tether::fluid::fluid_here()}, {"solid", tether::solid_here()}}));
}
