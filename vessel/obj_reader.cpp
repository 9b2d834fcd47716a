#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/error.hpp"
#include "vessel/readers.hpp"

namespace tether {

namespace {

/// The whole of a word, not only where it begins like a number: "3,5" is none.
template <class Number>
std::optional<Number> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

/// "12/5/7": the node 12, from 1; "-1": the last one so far. From 0.
int obj_node(std::string_view word, std::size_t nodes, const std::string& place) {
  std::string_view rest = word;
  std::optional<int> number;
  for (bool first = true; first || !rest.empty(); first = false) {  // what is behind the slashes may be left out
    const std::string_view part = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    const auto its = number_of<int>(part);
    if (first) number = its;
    if (!its && (first || !part.empty()))
      throw input_error("{}: '{}' is no node: must be a number, or numbers with slashes between them", place, word);
  }
  const int node = *number < 0 ? static_cast<int>(nodes) + *number : *number - 1;
  if (node < 0 || node >= static_cast<int>(nodes))
    throw input_error("{}: names node {}: {} stand before it, numbered from 1", place, *number, nodes);
  return node;
}

/// Behind the coordinates a weight or a colour may stand.
Vec3 obj_point(const std::vector<std::string>& words, const std::string& place) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    const auto number = number_of<double>(word);
    if (!number || !std::isfinite(*number))
      throw input_error("{}: '{}' is not a number (numbers have points, not commas: 0.5)", place, word);
    numbers.push_back(*number);
  }
  if (numbers.size() < 3) throw input_error("{}: three coordinates were expected behind v", place);
  return {numbers[0], numbers[1], numbers[2]};
}

/// Up to a comment.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line.substr(0, line.find('#')));
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace

MeshFile read_obj(const std::filesystem::path& path) {
  std::istringstream lines(file_content(path));
  MeshFile mesh;
  mesh.name = path.string();
  std::vector<Vec3> points;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    const std::string place = fmt::format("{}:{}", mesh.name, number), keyword = words.front();
    words.erase(words.begin());
    if (keyword == "v") {
      points.push_back(obj_point(words, place));
    } else if (keyword == "f") {
      std::vector<int> nodes;
      for (const std::string& word : words) nodes.push_back(obj_node(word, points.size(), place));
      if (nodes.size() < 3) throw input_error("{}: a face of {} nodes", place, nodes.size());
      for (std::size_t i = 2; i < nodes.size(); ++i) mesh.triangles.push_back({nodes[0], nodes[i - 1], nodes[i]});
    } else if (keyword == "V" || keyword == "F") {
      throw input_error("{}: the line begins with {}: must be a small letter", place, keyword);
    }
  }
  if (mesh.triangles.empty()) throw input_error("{}: holds no face", mesh.name);
  mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points.col(static_cast<Eigen::Index>(i)) = points[i];
  return mesh;
}

}  // namespace tether
