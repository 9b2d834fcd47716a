#include "identification_master/application.hpp"

int main(int argc, char** argv) {
  return tether::run_main(argc, argv, tether::identification_master_program());
}
