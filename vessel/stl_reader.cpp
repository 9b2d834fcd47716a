#include <cstring>
#include <map>
#include <optional>
#include <sstream>

#include "common/base/error.hpp"
#include "vessel/readers.hpp"

namespace tether {

namespace {

/// Gives equal corners one node.
class Merger {
 public:
  void add(const std::array<Vec3, 3>& corners) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = node(corners[i]);
    const bool collapsed = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!collapsed) triangles_.push_back(triangle);
  }
  MeshFile mesh(const std::string& name) const {
    MeshFile mesh;
    mesh.name = name;
    mesh.triangles = triangles_;
    mesh.points.resize(3, static_cast<Eigen::Index>(nodes_.size()));
    for (const auto& [x, node] : nodes_) mesh.points.col(node) << x[0], x[1], x[2];
    return mesh;
  }

 private:
  int node(const Vec3& x) {
    return nodes_.emplace(std::array<double, 3>{x[0], x[1], x[2]}, static_cast<int>(nodes_.size())).first->second;
  }
  std::map<std::array<double, 3>, int> nodes_;
  std::vector<Triangle> triangles_;
};

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

/// As a binary file states it; nothing of a file too short for it.
std::optional<std::uint32_t> stated_facets(const std::string& content) {
  std::uint32_t count = 0;
  if (content.size() < header_bytes) return std::nullopt;
  std::memcpy(&count, content.data() + 80, sizeof count);
  return count;
}

/// A binary file is as long as its number of facets says; many begin with "solid" all the same.
bool is_binary(const std::string& content) {
  const auto count = stated_facets(content);
  return count && content.size() == header_bytes + facet_bytes * *count;
}

void read_binary(const std::string& name, const std::string& content, Merger& merger) {
  for (std::size_t facet = header_bytes; facet < content.size(); facet += facet_bytes) {
    std::array<float, 12> numbers;  // normal, three corners
    std::memcpy(numbers.data(), content.data() + facet, sizeof numbers);
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = Vec3(numbers[3 + 3 * i], numbers[4 + 3 * i], numbers[5 + 3 * i]);
      if (!corners[i].allFinite())
        throw input_error("{}: facet {} (from 0) has a corner ({}, {}, {}) that is not finite", name,
                          (facet - header_bytes) / facet_bytes, corners[i][0], corners[i][1], corners[i][2]);
    }
    merger.add(corners);
  }
}

void read_text(const std::string& name, const std::string& content, Merger& merger) {
  std::istringstream lines(content);
  std::string line, word;
  std::array<Vec3, 3> corners;
  std::size_t corner = 0;
  bool ended = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    if (!(words >> word)) continue;
    ended = word == "endsolid";
    if (word != "vertex") continue;
    Vec3& x = corners[corner];
    if (!(words >> x[0] >> x[1] >> x[2]))
      throw input_error("{}:{}: three coordinates were expected behind vertex", name, number);
    if (words >> word)
      throw input_error("{}:{}: '{}' stands behind three coordinates", name, number, word.substr(0, 40));
    corner = (corner + 1) % 3;
    if (corner == 0) merger.add(corners);
  }
  if (corner != 0) throw input_error("{}: the last facet has {} corners instead of three", name, corner);
  if (!ended) throw input_error("{}: ends without \"endsolid\": cut short?", name);
}

/// Neither as long as it states, nor text.
InputError unreadable(const std::string& name, const std::string& content) {
  if (const auto count = stated_facets(content); count && content.size() < header_bytes + facet_bytes * *count)
    return input_error(
        "{}: is neither text STL (begins with \"solid\") nor binary STL of the length it states: {} facets take {} "
        "bytes, "
        "it has {}: cut short?",
        name, *count, header_bytes + facet_bytes * *count, content.size());
  return input_error("{}: is neither text STL (begins with \"solid\") nor binary STL of the length it states", name);
}

}  // namespace

MeshFile read_stl(const std::filesystem::path& path) {
  const std::string content = file_content(path);
  Merger merger;
  if (is_binary(content)) {
    read_binary(path.string(), content, merger);
  } else if (content.starts_with("solid") && content.find('\0') == std::string::npos) {
    read_text(path.string(), content, merger);
  } else {
    throw unreadable(path.string(), content);
  }
  MeshFile mesh = merger.mesh(path.string());
  if (mesh.triangles.empty()) throw input_error("{}: holds no triangle", path.string());
  return mesh;
}

}  // namespace tether
