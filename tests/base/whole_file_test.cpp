#include "common/base/whole_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "common/base/error.hpp"
#include "common/base/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string refusal(const fs::path& file, const std::string& bytes) {
  try {
    write_whole(file, bytes);
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

/// Files of this process end there [bytes], as a disk that is full ends them.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(WholeFile, StandsInPlaceOfTheOneBefore) {
  const ScratchFolder folder("whole");
  const fs::path file = folder.path() / "record.json";
  write_whole(file, "first");
  write_whole(file, std::string("\0second", 7));
  EXPECT_EQ(content(file), std::string("\0second", 7));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing beside";
}

TEST(WholeFile, TheOneBeforeIsKeptWhereItCannotBeWritten) {
  const ScratchFolder folder("whole");
  const fs::path file = folder.path() / "record.json";
  write_whole(file, "first");
  std::string told;
  {
    const SizeLimit limit(1 << 16);
    told = refusal(file, std::string(1 << 20, 'x'));
  }
  EXPECT_NE(told.find("record.json: cannot be written: File too large"), std::string::npos) << told;
  EXPECT_EQ(content(file), "first");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing beside";
}

TEST(WholeFile, WhatCannotBeReplacedIsTold) {
  const ScratchFolder folder("whole");
  fs::create_directories(folder.path() / "record.json/something");
  const std::string told = refusal(folder.path() / "record.json", "first");
  EXPECT_NE(told.find("record.json: cannot be written: Is a directory"), std::string::npos) << told;
  EXPECT_FALSE(fs::exists(folder.path() / "record.json.part"));
  EXPECT_NE(refusal(folder.path() / "gone/record.json", "first").find("its folder is gone"), std::string::npos);
}

TEST(WholeFile, ALinkBesideIsNotFollowed) {
  const ScratchFolder folder("whole");
  const fs::path file = folder.path() / "record.json", other = folder.path() / "other";
  std::ofstream(other) << "of somebody";
  fs::create_symlink(other, file.string() + ".part");
  write_whole(file, "first");
  EXPECT_EQ(content(other), "of somebody");
  EXPECT_EQ(content(file), "first");
}

}  // namespace
}  // namespace tether
