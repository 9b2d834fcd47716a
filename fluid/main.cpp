#include "fluid/application.hpp"

int main(int argc, char** argv) {
  return tether::run_main(argc, argv, tether::fluid::fluid_program());
}
