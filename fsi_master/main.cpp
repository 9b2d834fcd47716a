#include "fsi_master/application.hpp"

int main(int argc, char** argv) {
  return tether::run_main(argc, argv, tether::fsi_master_program());
}
