#pragma once

#include <span>
#include <string_view>

namespace tether {

/// A file of report/page, as it was when this program was built; its modules bundled as one script.
struct PageFile {
  std::string_view name, content;
};

/// page.html, style.css, page.js.
std::span<const PageFile> page_files();

}  // namespace tether
