#include "observation_manager/application.hpp"

int main(int argc, char** argv) {
  return tether::run_main(argc, argv, tether::observation_program());
}
