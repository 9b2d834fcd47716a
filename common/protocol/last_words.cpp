#include "common/protocol/last_words.hpp"

#include <filesystem>
#include <fstream>

#include "common/base/process.hpp"
#include "common/base/temporary_folder.hpp"

namespace tether::protocol {
namespace {

std::filesystem::path file_of(std::int64_t pid) {
  return temporary_folder() / fmt::format("tether-last-words-{}-{}", host_name(), pid);
}

}  // namespace

void leave_last_words(const std::string& words) {
  std::ofstream(file_of(process_id())) << words << "\n";
}

std::string last_words_of(const Peer& peer) {
  if (peer.pid == 0 || peer.host != host_name()) return {};
  const std::filesystem::path file = file_of(peer.pid);
  std::string words;
  std::getline(std::ifstream(file), words);
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  return words;
}

}  // namespace tether::protocol
