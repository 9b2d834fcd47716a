#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {

inline std::filesystem::path write_file(const std::string& name, const std::string& text) {
  const auto path = test_folder() / name;
  std::ofstream(path) << text;
  return path;
}

/// The message of the InputError that `body` throws, without the test's folder; "no error" if it throws none.
template <class Body>
std::string input_error_of(Body body) {
  try {
    body();
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string folder = test_folder().string() + "/";
    for (std::size_t at = 0; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
    return text;
  }
  return "no error";
}

/// Five lines that make a valid case; what a test adds starts on line 6.
inline const std::string valid_head = "name: tube\nunits: cgs\ntime:\n  step: 2e-3\n  end: 0.9\n";

/// The message that reading `Section` from `fluid:` gives for a case that consists of the valid head and `text`.
template <class Section>
std::string errors_in(const std::string& text, Section section = {}) {
  const auto path = write_file("case.yaml", valid_head + text);
  return input_error_of([&] {
    CaseFile file(path);
    file.read("fluid", section);
    file.finish();
  });
}

}  // namespace tether
