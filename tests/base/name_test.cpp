#include "common/base/name.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "common/base/error.hpp"

namespace tether {
namespace {

TEST(Name, IsOfLettersDigitsAndAFewSigns) {
  for (const char* good : {"spine", "S1", "z = 12 mm", "left (outer)", "a.b_c-d+e", "äußere Wand", "50%"})
    EXPECT_TRUE(is_name(good)) << good;
  for (const char* bad : {"",         " spine", "spine ", "it's", "a, b",
                          "a\nb",     "a\tb",   "\"a\"",  "a`b`", "a\\b",
                          "../a",     "a;b",    "$a",     "..",   "a\u2028b",
                          "a\u0085b", "a[mm]",  "#3",     "a: b", "S'; system 'id'; set title 'q"})
    EXPECT_FALSE(is_name(bad)) << bad;
  EXPECT_TRUE(is_name(std::string(100, 'a')));
  EXPECT_FALSE(is_name(std::string(101, 'a')));
  EXPECT_FALSE(
      is_name("Stra\xDF"
              "e"))
      << "Latin-1";
}

/// A mark of direction, a joiner, a space without width, the mark of an order of bytes.
constexpr std::array unseen{"\u200b", "\u200e", "\u202e", "\u2066", "\ufeff", "\u2028", "\u0085", "\x1b", "\x7f"};

TEST(Name, HasNoCharacterThatIsNotSeen) {
  for (const char* character : unseen) {
    EXPECT_FALSE(is_name("a" + std::string(character) + "b")) << character;
    EXPECT_FALSE(is_printable("a" + std::string(character))) << character;
    EXPECT_EQ(printable(std::string(character) + "b"), "?b");
  }
  EXPECT_TRUE(is_printable("ends of\nlines\tand tabs, äußere Wand"));
  EXPECT_EQ(printable("two\nlines\t\u4e2d"), "two\nlines\t\u4e2d");
  EXPECT_EQ(printable("Stra\xDF"
                      "e"),
            "Stra?e")
      << "Latin-1";
}

TEST(Errors, SayNothingThatATerminalObeys) {
  const std::string value("0.1\0\x1b[31m", 9);
  EXPECT_STREQ(input_error("flow.csv:3: '{}'", value).what(), "flow.csv:3: '0.1??[31m'");
  EXPECT_STREQ(run_error("flow.csv:3: '{}'", value).what(), "flow.csv:3: '0.1??[31m'");
  EXPECT_STREQ(InputError("first\nsecond").what(), "first\nsecond");
}

TEST(Utf8, IsWhatTheStandardSays) {
  for (const char* good : {"", "abc", "ä", "€", "\xF0\x9F\x98\x80", "\xED\x9F\xBF", "\xEE\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_TRUE(is_utf8(good)) << good;
  for (const char* bad : {"\x80", "\xC3", "\xC3(", "\xC0\xAF", "\xE0\x80\xAF", "\xE2\x82", "\xED\xA0\x80",
                          "\xF0\x80\x80\xAF", "\xF4\x90\x80\x80", "\xFE", "\xFF"})
    EXPECT_FALSE(is_utf8(bad));
  EXPECT_EQ(first_line_not_utf8("a\nb\xE9\nc"), 2);
  EXPECT_EQ(first_line_not_utf8("a\nb\nc"), 0);
}

TEST(FileName, LeavesRoomForWhatIsAddedToIt) {
  EXPECT_TRUE(is_file_name(std::string(200, 'a')));
  EXPECT_FALSE(is_file_name(std::string(201, 'a')));
  for (const char* bad : {"", ".a", "a/b", "a b"}) EXPECT_FALSE(is_file_name(bad)) << bad;
}

}  // namespace
}  // namespace tether
