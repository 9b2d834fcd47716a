#include <sstream>

#include "common/base/error.hpp"
#include "vessel/readers.hpp"

namespace tether {

namespace {

/// "12/5/7": the node 12, from 1; "-1": the last one so far. From 0.
int obj_node(const std::string& word, std::size_t nodes, const std::string& place) {
  std::size_t read = 0;
  int number = 0;
  try {
    number = std::stoi(word, &read);
  } catch (const std::exception&) {
    throw input_error("{}: '{}' is no node", place, word);
  }
  const int node = number < 0 ? static_cast<int>(nodes) + number : number - 1;
  if (node < 0 || node >= static_cast<int>(nodes))
    throw input_error("{}: names node {}: {} stand before it, numbered from 1", place, number, nodes);
  return node;
}

}  // namespace

MeshFile read_obj(const std::filesystem::path& path) {
  std::istringstream lines(file_content(path));
  MeshFile mesh;
  mesh.name = path.string();
  std::vector<Vec3> points;
  std::string line, word;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    const std::string place = fmt::format("{}:{}", mesh.name, number);
    if (!(words >> word)) continue;
    if (word == "v") {
      Vec3& x = points.emplace_back();
      if (!(words >> x[0] >> x[1] >> x[2])) throw input_error("{}: three coordinates were expected behind v", place);
    } else if (word == "f") {
      std::vector<int> nodes;
      while (words >> word) nodes.push_back(obj_node(word, points.size(), place));
      if (nodes.size() < 3) throw input_error("{}: a face of {} nodes", place, nodes.size());
      for (std::size_t i = 2; i < nodes.size(); ++i) mesh.triangles.push_back({nodes[0], nodes[i - 1], nodes[i]});
    }
  }
  if (mesh.triangles.empty()) throw input_error("{}: holds no face", mesh.name);
  mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points.col(static_cast<Eigen::Index>(i)) = points[i];
  return mesh;
}

}  // namespace tether
