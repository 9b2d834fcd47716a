#include "solid/application.hpp"

int main(int argc, char** argv) {
  return tether::run_main(argc, argv, tether::solid_program());
}
