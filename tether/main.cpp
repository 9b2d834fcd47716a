#include "tether/front_end.hpp"

int main(int argc, char** argv) {
  return tether::front_end(argc, argv);
}
