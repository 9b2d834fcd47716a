#include "report/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/page_files.hpp"

namespace tether {
namespace {

TEST(Page, NeedsNoOtherFile) {
  const std::string page = page_of("A tube", R"({"title": "A tube"})");
  for (const char* other : {"src=", "href=", "@import", "url(", "fetch("})
    EXPECT_EQ(page.find(other), std::string::npos) << other;
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos) << "and may not ask for one";
  EXPECT_NE(page.find("<title>A tube</title>"), std::string::npos);
  for (const PageFile& file : page_files())
    EXPECT_TRUE(file.name == "page.html" || page.find(file.content) != std::string::npos) << file.name;
}

TEST(Page, TextOfCasesIsNotMarkup) {
  const std::string evil = "</script><script>alert(1)</script> {{style}} & \"quoted\"";
  const std::string document = nlohmann::json{{"title", evil}}.dump();
  const std::string page = page_of(evil, document), harmless = page_of("", "{}");
  const auto count = [](const std::string& text, const std::string& piece) {
    int n = 0;
    for (auto at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(page, "<script"), count(harmless, "<script"));
  EXPECT_EQ(count(page, "</script"), count(harmless, "</script"));
  EXPECT_EQ(count(page, ":root {"), count(harmless, ":root {")) << "what is filled in is not filled in again";
  EXPECT_EQ(nlohmann::json::parse(json_in_html(document))["title"], evil) << "and is the same text";
}

}  // namespace
}  // namespace tether
