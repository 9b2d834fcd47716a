#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/fuzz/readers.hpp"

/// A reader under libFuzzer: fuzzer --reader=ply FLAGS FOLDERS (tests/fuzz/run says how).
namespace {

const tether::fuzz::FuzzedReader* chosen = nullptr;

const tether::fuzz::FuzzedReader* named(std::string_view name) {
  for (const auto& reader : tether::fuzz::readers())
    if (reader.name == name) return &reader;
  return nullptr;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--reader=";
  for (int i = 1; i < *count; ++i)
    if (const std::string_view argument = (*arguments)[i]; argument.starts_with(option))
      chosen = named(argument.substr(option.size()));
  if (chosen != nullptr) return 0;
  std::fprintf(stderr, "--reader= one of");
  for (const auto& reader : tether::fuzz::readers()) std::fprintf(stderr, " %s", reader.name.data());
  std::fprintf(stderr, "\n");
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  tether::fuzz::read_any(*chosen, std::string(bytes, bytes + size));
  return 0;
}
