#include "common/protocol/told.hpp"

#include <cstdlib>
#include <fstream>

namespace tether::protocol {

void note_told(Told what) {
  if (const char* file = std::getenv(told_variable)) std::ofstream(file) << static_cast<int>(what) << "\n";
}

Told take_note(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return Told::nothing;
  int word = 0;
  const bool is_interruption = (std::ifstream(file) >> word) && word == static_cast<int>(Told::interruption);
  std::filesystem::remove(file, error);
  return is_interruption ? Told::interruption : Told::failure;
}

}  // namespace tether::protocol
