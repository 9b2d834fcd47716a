#pragma once

#include <string>

namespace tether {

/// The whole page, which needs no other file. title: plain text; document: what `collected` returns.
std::string page_of(const std::string& title, const std::string& document);

/// Text that means itself in HTML.
std::string html_text(const std::string& text);
/// JSON that cannot end the script it stands in.
std::string json_in_html(const std::string& json);

}  // namespace tether
