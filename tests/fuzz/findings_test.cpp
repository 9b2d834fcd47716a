#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/fuzz/readers.hpp"
#include "tests/io/less_memory.hpp"
#include "tests/io/work.hpp"

namespace tether::fuzz {
namespace {

namespace fs = std::filesystem;

struct Kept {
  FuzzedReader reader;
  fs::path file;
};

/// What stands in tests/fuzz/seeds or tests/fuzz/findings.
std::vector<Kept> kept_in(const std::string& folder) {
  std::vector<Kept> all;
  for (const FuzzedReader& reader : readers())
    if (const fs::path its = fs::path("tests/fuzz") / folder / reader.name; fs::exists(its))
      for (const auto& entry : fs::directory_iterator(its)) all.push_back({reader, entry.path()});
  return all;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_end_of(const Kept& kept) {
  SCOPED_TRACE(kept.file.string());
  const Work work;
  EXPECT_NO_THROW(read_any(kept.reader, content(kept.file)));
  EXPECT_LT(work.seconds(), 10);
}

TEST(Fuzzed, FindingsAreReadOrRefused) {
  const LessMemory memory(std::size_t{1} << 30);
  const std::vector<Kept> findings = kept_in("findings");
  EXPECT_FALSE(findings.empty());
  for (const Kept& kept : findings) expect_end_of(kept);
}

/// Without a refusal: what fuzzers begin with leads into the reader.
TEST(Fuzzed, SeedsAreRead) {
  for (const Kept& kept : kept_in("seeds")) {
    SCOPED_TRACE(kept.file.string());
    EXPECT_NO_THROW(kept.reader.read({kept.reader.name, content(kept.file)}));
  }
}

TEST(Fuzzed, EachReaderHasSeeds) {
  for (const FuzzedReader& reader : readers())
    EXPECT_TRUE(fs::exists(fs::path("tests/fuzz/seeds") / reader.name)) << reader.name;
}

/// What stands in a folder that has another name than any reader would never be read.
TEST(Fuzzed, EachFolderHasAReader) {
  for (const char* kind : {"seeds", "findings"})
    for (const auto& folder : fs::directory_iterator(fs::path("tests/fuzz") / kind)) {
      const std::string name = folder.path().filename();
      EXPECT_TRUE(std::ranges::any_of(readers(), [&](const FuzzedReader& reader) { return reader.name == name; }))
          << folder.path();
    }
}

}  // namespace
}  // namespace tether::fuzz
