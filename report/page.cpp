#include "report/page.hpp"

#include <map>
#include <stdexcept>

#include "report/page_files.hpp"

namespace tether {
namespace {

/// {{name}} of the template becomes the value of that name; what is put in is not searched again.
std::string filled(std::string_view form, const std::map<std::string, std::string, std::less<>>& values) {
  std::string text;
  while (true) {
    const auto open = form.find("{{");
    text += form.substr(0, open);
    if (open == std::string_view::npos) return text;
    const auto close = form.find("}}", open);
    text += values.at(std::string(form.substr(open + 2, close - open - 2)));
    form.remove_prefix(close + 2);
  }
}

std::string replaced(const std::string& text, const std::map<char, std::string_view>& by) {
  std::string result;
  for (const char c : text) {
    const auto found = by.find(c);
    if (found == by.end())
      result += c;
    else
      result += found->second;
  }
  return result;
}

}  // namespace

std::string html_text(const std::string& text) {
  return replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}});
}

std::string json_in_html(const std::string& json) {
  return replaced(json, {{'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}});
}

std::string page_of(const std::string& title, const std::string& document) {
  std::string_view form;
  std::map<std::string, std::string, std::less<>> values{{"title", html_text(title)}, {"data", json_in_html(document)}};
  for (const PageFile& file : page_files()) {
    if (file.name == "page.html") form = file.content;
    if (file.name.ends_with(".css")) values["style"] += file.content;
    if (file.name.ends_with(".js")) values["script"] += file.content;
  }
  return filled(form, values);
}

}  // namespace tether
