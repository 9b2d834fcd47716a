#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "batch/job.hpp"
#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {

/// A folder for a job, and jobs of cases in it.
class Jobs : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string refusal(const std::function<void()>& act) const {
    try {
      act();
    } catch (const InputError& error) {
      const std::string text = error.what(), here = folder_.string() + "/";
      return text.starts_with(here) ? text.substr(here.size()) : text;
    }
    return "no error";
  }
  Job job(JobVerb verb, int cases) const {
    Job job{verb, "12", "/opt/it's here/tether", {}, {}, {}};
    for (int k = 0; k < cases; ++k)
      job.cases.push_back({"case_" + std::to_string(k), (folder_ / "a case.yaml").string()});
    return job;
  }
  const std::filesystem::path folder_ = test_folder();
};

}  // namespace tether
