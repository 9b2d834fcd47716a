#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <list>
#include <string>

namespace tether {

/// A folder of the test that goes away with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("tether_") + test->test_suite_name() + "_" + test->name() + "_" +
                       std::to_string(getpid()) + "_" + std::to_string(++count_);
    std::replace(name.begin(), name.end(), '/', '_');  // of a test with parameters: one folder, all of which goes away
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// The path of a new file with this content.
  std::filesystem::path file(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
  static inline int count_ = 0;
};

/// The folder of the test that runs, for functions beside it. It goes away with the program, not with the test: a
/// program holds its output folder to its end (hold_output).
inline const std::filesystem::path& test_folder() {
  class OfTheTests : public ::testing::EmptyTestEventListener {
   public:
    void OnTestEnd(const ::testing::TestInfo&) override { is_for_this_test = false; }
    std::list<TemporaryFolder> folders;
    bool is_for_this_test = false;
  };
  static OfTheTests* const made = [] {
    auto* const listener = new OfTheTests;  // listeners() owns it
    ::testing::UnitTest::GetInstance()->listeners().Append(listener);
    return listener;
  }();
  if (!made->is_for_this_test) made->folders.emplace_back();
  made->is_for_this_test = true;
  return made->folders.back().path();
}

/// What the call's exception says; "accepted" if there is none.
template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace tether
