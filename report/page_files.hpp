#pragma once

#include <span>
#include <string_view>

namespace tether {

/// A file of report/page, as it was when this program was built.
struct PageFile {
  std::string_view name, content;
};

/// page.html, style.css, then the scripts in the order in which they run.
std::span<const PageFile> page_files();

}  // namespace tether
