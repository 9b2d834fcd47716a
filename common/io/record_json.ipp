#pragma once

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/types.hpp"
#include "common/base/whole_file.hpp"
#include "common/io/record.hpp"
#include "common/io/record_file.hpp"

/// Records to JSON and back. For the sources that make a record's file alone: it is heavy.
namespace tether::record_json {

using Json = nlohmann::ordered_json;

struct Write {
  template <class T>
  static Json of(const T& value) {
    if constexpr (Record<T>) {
      Json json = Json::object();
      T::fields(value, [&](const char* name, const auto& field, const char*) { json[name] = of(field); });
      return json;
    } else if constexpr (Worded<T>) {
      return word_of(value);
    } else if constexpr (std::is_floating_point_v<T>) {
      return std::isfinite(value) ? Json(value) : Json();
    } else {
      return value;
    }
  }
  template <class T>
  static Json of(const std::optional<T>& value) {
    return value ? of(*value) : Json();
  }
  template <class T>
  static Json of(const std::vector<T>& values) {
    Json json = Json::array();
    for (const T& value : values) json.push_back(of(value));
    return json;
  }
  template <class T>
  static Json of(const std::map<std::string, T>& values) {
    Json json = Json::object();
    for (const auto& [name, value] : values) json[name] = of(value);
    return json;
  }
  static Json of(const JsonTree& tree) { return Json::parse(tree.text); }
  static Json of(const Vec3& vector) { return of(std::vector<double>(vector.begin(), vector.end())); }
  static Json of(const MatrixXd& matrix) {
    Json rows = Json::array();
    for (const auto& row : matrix.rowwise()) rows.push_back(of(std::vector<double>(row.begin(), row.end())));
    return rows;
  }
};

/// Where in a file something is read, for messages: "diagnosis.json: effects[3].amplitude.value".
struct Place {
  std::string file, path;
  Place at(const std::string& field) const { return {file, path.empty() ? field : path + "." + field}; }
  Place at(std::size_t item) const { return {file, path + "[" + std::to_string(item) + "]"}; }
  InputError wrong(const Json& json, const std::string& expected) const {
    const std::string where = path.empty() ? file : file + ": " + path;
    return input_error("{}: {}: must be {}", where, json.dump().substr(0, 80), expected);
  }
};

/// Every call throws InputError for what is missing or of another kind; fields that the record does not know are left.
struct Read {
  template <class T>
  static void into(T& value, const Json& json, const Place& place) {
    if constexpr (Record<T>)
      fields(value, json, place);
    else if constexpr (Worded<T>)
      value = word<T>(json, place);
    else if constexpr (std::is_same_v<T, std::string>)
      json.is_string() ? json.get_to(value) : throw place.wrong(json, "a text");
    else if constexpr (std::is_same_v<T, bool>)
      json.is_boolean() ? json.get_to(value) : throw place.wrong(json, "true or false");
    else if constexpr (std::is_integral_v<T>)
      value = whole<T>(json, place);
    else
      value = number(json, place);
  }
  template <class T>
  static void into(std::optional<T>& value, const Json& json, const Place& place) {
    value.reset();
    if (!json.is_null()) into(value.emplace(), json, place);
  }
  template <class T>
  static void into(std::vector<T>& values, const Json& json, const Place& place) {
    if (!json.is_array()) throw place.wrong(json, "a list");
    values.resize(json.size());
    for (std::size_t i = 0; i < values.size(); ++i) into(values[i], json[i], place.at(i));
  }
  template <class T>
  static void into(std::map<std::string, T>& values, const Json& json, const Place& place) {
    if (!json.is_object()) throw place.wrong(json, "an object");
    values.clear();
    for (const auto& [name, item] : json.items()) into(values[name], item, place.at(name));
  }
  static void into(JsonTree& tree, const Json& json, const Place& place) {
    if (!json.is_object()) throw place.wrong(json, "an object");
    tree.text = json.dump();
  }
  static void into(Vec3& vector, const Json& json, const Place& place) {
    std::vector<double> values;
    into(values, json, place);
    if (values.size() != 3) throw place.wrong(json, "three numbers");
    vector = Eigen::Map<const Vec3>(values.data());
  }
  static void into(MatrixXd& matrix, const Json& json, const Place& place) {
    std::vector<std::vector<double>> rows;
    into(rows, json, place);
    const std::size_t columns = rows.empty() ? 0 : rows.front().size();
    matrix.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].size() != columns) throw place.at(i).wrong(json[i], "as long as the first row");
      for (std::size_t j = 0; j < columns; ++j)
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    }
  }

 private:
  template <class T>
  static constexpr bool may_be_missing(const T&) {
    return false;
  }
  template <class T>
  static constexpr bool may_be_missing(const std::optional<T>&) {
    return true;
  }
  template <class T>
  static void fields(T& record, const Json& json, const Place& place) {
    if (!json.is_object()) throw place.wrong(json, "an object");
    T::fields(record, [&](const char* name, auto& field, const char*) {
      const auto found = json.find(name);
      if (found != json.end()) return into(field, *found, place.at(name));
      if (!may_be_missing(field)) throw input_error("{}: {}: is missing", place.file, place.at(name).path);
    });
  }
  template <class E>
  static E word(const Json& json, const Place& place) {
    const auto value = json.is_string() ? from_word<E>(json.get_ref<const std::string&>()) : std::nullopt;
    if (value) return *value;
    std::string all;
    for (const WordOf<E>& word : words_of<E>) all += (all.empty() ? "one of " : ", ") + std::string(word.word);
    throw place.wrong(json, all);
  }
  /// 2.0 is one, too, as in a schema.
  template <class T>
  static T whole(const Json& json, const Place& place) {
    if (json.is_number_unsigned()) return fitting<T>(json.get<std::uint64_t>(), json, place);
    if (json.is_number_integer()) return fitting<T>(json.get<std::int64_t>(), json, place);
    const double number = json.is_number_float() ? json.get<double>() : 0.5;
    if (std::trunc(number) != number) throw place.wrong(json, "a whole number");
    constexpr double most = 9e15;  // each whole number up to it is a double
    if (!(std::abs(number) <= most)) throw place.wrong(json, allowed<T>());
    return fitting<T>(static_cast<std::int64_t>(number), json, place);
  }
  /// What a type cannot hold would be another number.
  template <class T, class Number>
  static T fitting(Number number, const Json& json, const Place& place) {
    if (!std::in_range<T>(number)) throw place.wrong(json, allowed<T>());
    return static_cast<T>(number);
  }
  template <class T>
  static std::string allowed() {
    return fmt::format("a whole number from {} to {}", std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
  }
  static double number(const Json& json, const Place& place) {
    if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
    return json.is_number() ? json.get<double>() : throw place.wrong(json, "a number or null");
  }
};

/// Collects the schemas of all records that a type is made of.
class Schema {
 public:
  template <class T>
  Json whole(const std::string& title) {
    Json json{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
    json.update(of(static_cast<const T*>(nullptr)));
    json["$defs"] = records_;
    return json;
  }

 private:
  template <class T>
  Json of(const T*) {
    if constexpr (Record<T>) {
      if (!records_.contains(T::type_name)) add<T>();
      return {{"$ref", std::string("#/$defs/") + T::type_name}};
    } else if constexpr (Worded<T>) {
      return words<T>();
    } else if constexpr (std::is_same_v<T, std::string>) {
      return {{"type", "string"}};
    } else if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_integral_v<T>) {
      return {{"type", "integer"}};
    } else {
      return {{"type", {"number", "null"}}};
    }
  }
  template <class T>
  Json of(const std::optional<T>*) {
    return {{"anyOf", {of(static_cast<const T*>(nullptr)), {{"type", "null"}}}}};
  }
  template <class T>
  Json of(const std::vector<T>*) {
    return {{"type", "array"}, {"items", of(static_cast<const T*>(nullptr))}};
  }
  template <class T>
  Json of(const std::map<std::string, T>*) {
    return {{"type", "object"}, {"additionalProperties", of(static_cast<const T*>(nullptr))}};
  }
  Json of(const JsonTree*) { return {{"type", "object"}}; }
  Json of(const Vec3*) { return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}}; }
  Json of(const MatrixXd*) { return of(static_cast<const std::vector<std::vector<double>>*>(nullptr)); }

  template <class E>
  static Json words() {
    Json all = Json::array();
    for (const WordOf<E>& word : words_of<E>) all.push_back({{"const", word.word}, {"description", word.meaning}});
    return {{"oneOf", all}};
  }
  template <class T>
  void add() {
    records_[T::type_name] = nullptr;  // its place; it may hold itself
    Json properties = Json::object(), required = Json::array();
    T::fields(static_cast<const T&>(T{}), [&](const char* name, const auto& field, const char* meaning) {
      properties[name] = of(&field);
      properties[name]["description"] = meaning;
      required.push_back(name);
    });
    records_[T::type_name] = {{"type", "object"},
                              {"properties", properties},
                              {"required", required},
                              {"additionalProperties", false}};
  }

  Json records_ = Json::object();
};

/// What a file of a record may have [bytes]: the JSON of a list takes twenty times its text in memory, and what is told
/// of a run is some MB. One with packed numbers, which take no more than they have, says so by `largest_file`.
template <class T>
constexpr std::uintmax_t largest_file_of() {
  if constexpr (requires { T::largest_file; }) return T::largest_file;
  return 64'000'000;
}

/// A parser takes memory, and then its stack, for each list that is begun.
inline void check_depth(const std::string& text, const std::string& from) {
  constexpr int most = 64;  // a record of records has ten
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') in_text = !in_text;
    if (in_text) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > most) throw input_error("{}: is nested deeper than any record: {} levels", from, most);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

}  // namespace tether::record_json

namespace tether {

template <class T>
std::string json_of(const T& record) {
  return record_json::Write::of(record).dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

template <class T>
void write_record(const std::filesystem::path& path, const T& record) {
  write_whole(path, json_of(record) + "\n");
}

namespace record_json {

/// Throws InputError for what is no JSON, and for an object that has a key twice: one of its values would be lost.
inline Json parsed(const std::string& text, const std::string& from) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  std::string twice;
  const Json::parser_callback_t look = [&](int, Json::parse_event_t event, Json& key) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(key.get_ref<const std::string&>()).second)
      twice = key.get_ref<const std::string&>();
    return true;
  };
  Json json = Json::parse(text, look, false);
  if (json.is_discarded()) throw input_error("{}: is no JSON", from);
  if (!twice.empty()) throw input_error("{}: {}: stands twice in one object: must stand once", from, twice);
  return json;
}

}  // namespace record_json

template <class T>
T record_of(const std::string& text, const std::string& from) {
  record_json::check_depth(text, from);
  const auto json = record_json::parsed(text, from);
  T record;
  record_json::Read::into(record, json, {from, ""});
  return record;
}

template <class T>
T read_record(const std::filesystem::path& path) {
  return record_of<T>(content_of(path, record_json::largest_file_of<T>()), path.string());
}

template <class T>
std::string schema_of(const std::string& title) {
  return record_json::Schema().whole<T>(title).dump(1) + "\n";
}

}  // namespace tether

/// In the one source that makes the JSON of this record.
#define TETHER_RECORD(Type)                                                 \
  template std::string json_of(const Type&);                                \
  template Type record_of(const std::string&, const std::string&);          \
  template void write_record(const std::filesystem::path&, const Type&);    \
  template Type read_record(const std::filesystem::path&);                  \
  template std::string schema_of<Type>(const std::string&)
