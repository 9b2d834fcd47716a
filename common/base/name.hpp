#pragma once

#include <string>
#include <string_view>

namespace tether {

/// The rule for names that users give: regions, slices, points, outlets. They become columns of tables, labels of plots
/// and parts of file names.
inline constexpr std::string_view name_rule = "a name consists of letters, digits, spaces and _-.+=()%";

/// The rule for those that a case gives to its own sections: fields are addressed by paths that are split at dots.
inline constexpr std::string_view field_name_rule = "a name in a case has no dot, which stands between names of a path";

/// Whether a text is such a name: not empty, of at most 100 bytes, without a space at either end, printable.
bool is_name(std::string_view text);

/// The rule for names of cases and studies, after which folders are named.
inline constexpr std::string_view file_name_rule =
    "must consist of letters, digits, '_', '-' and '.', at most 200 of them";
bool is_file_name(std::string_view text);

/// Whether a text is valid UTF-8, as all files of results must be (RFC 3629: no overlong forms, no surrogates).
bool is_utf8(std::string_view text);

/// The first line that is not; 0 if all are.
int first_line_not_utf8(std::string_view text);

/// Whether a text is valid UTF-8 of characters that are seen: of those that are not, or that a terminal or an editor
/// obeys (controls, marks of direction, joiners, separators of lines), only ends of lines and tabs.
bool is_printable(std::string_view text);

/// With ? in place of each character that is not.
std::string printable(std::string_view text);

}  // namespace tether
