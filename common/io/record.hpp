#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

/// What a file of results holds is declared once, beside its type: reading, writing and the JSON schema follow from it.
///
///   struct Gain {
///     static constexpr const char* type_name = "gain";
///     double value = 0, lower = 0, upper = 0;
///     static void fields(auto& self, auto&& field) {
///       field("value", self.value, "1 - rms after / rms before");
///       ...
///     }
///   };
///
/// A field is a number (not finite: null), a text, an enumeration with words, another record, an Eigen matrix (its
/// rows), a Vec3, a JsonTree, or a std::optional (empty: null), std::vector or std::map<std::string, ...> of these.
namespace tether {

/// How files name a value of an enumeration, and what that means.
template <class E>
struct WordOf {
  E value;
  const char* word;
  const char* meaning;
};

/// Specialised for each enumeration that a file holds: an array of WordOf<E>, one for each value.
template <class E>
inline constexpr std::array<WordOf<E>, 0> words_of{};

template <class E>
concept Worded = std::is_enum_v<E> &&(words_of<E>.size() > 0);

template <Worded E>
constexpr WordOf<E> entry_of(E value) {
  for (const WordOf<E>& word : words_of<E>)
    if (word.value == value) return word;
  return {value, "", ""};
}
template <Worded E>
constexpr const char* word_of(E value) {
  return entry_of(value).word;
}
template <Worded E>
constexpr const char* meaning_of(E value) {
  return entry_of(value).meaning;
}

/// Nothing if it is no word of the enumeration.
template <Worded E>
constexpr std::optional<E> from_word(std::string_view text) {
  for (const WordOf<E>& word : words_of<E>)
    if (text == word.word) return word.value;
  return std::nullopt;
}

/// A part of a file that is anything: an object as JSON text.
struct JsonTree {
  std::string text = "{}";
};

template <class T>
concept Record = requires {
  T::type_name;
};

}  // namespace tether
