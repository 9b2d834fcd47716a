#include <array>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/base/error.hpp"
#include "vessel/gmsh_source.hpp"
#include "vessel/readers.hpp"

/// Gmsh's .msh, versions 2.x and 4.1 (gmsh.info, "Gmsh file formats").
namespace tether {

namespace {

enum GmshElement {
  gmsh_line = 1,
  gmsh_triangle = 2,
  gmsh_quadrangle = 3,
  gmsh_tetrahedron = 4,
  gmsh_prism = 6,
  gmsh_point = 15
};

class GmshReader {
 public:
  explicit GmshReader(const std::filesystem::path& path) : source_(path.string(), file_content(path)) {
    mesh_.name = path.string();
  }

  MeshFile read() {
    read_format();
    while (!source_.at_end()) read_section(std::string(source_.word()));
    if (nodes_.empty()) source_.fail("has no $Nodes");
    take_points();
    return std::move(mesh_);
  }

 private:
  void read_format() {
    source_.expect("$MeshFormat");
    version_ = source_.text_number();
    const bool binary = source_.text_number() != 0;
    if (version_ < 2 || (version_ >= 3 && version_ < 4.1) || version_ >= 5)
      source_.fail(fmt::format("Gmsh format {}: must be 2.x or 4.1 (in Gmsh: Mesh.MshFileVersion)", version_));
    if (source_.text_number() != 8) source_.fail("numbers must have 8 bytes");
    source_.end_line();
    source_.set_binary(binary);
    if (binary && source_.integer() != 1) source_.fail("was written with another byte order");
    source_.expect("$EndMeshFormat");
  }

  void read_section(const std::string& name) {
    source_.end_line();
    if (name == "$PhysicalNames") {
      read_group_names();
    } else if (name == "$Entities") {
      read_entities();
    } else if (name == "$Nodes") {
      version_ < 4 ? read_nodes_2() : read_nodes_4();
    } else if (name == "$Elements") {
      version_ < 4 ? read_elements_2() : read_elements_4();
    } else if (name.starts_with('$')) {
      source_.skip_to("$End" + name.substr(1));
      return;
    } else {
      source_.fail("a section ($...) was expected");
    }
    source_.expect("$End" + name.substr(1));
  }

  void read_group_names() {
    for (auto left = source_.text_integer(); left > 0; --left) {
      const double dimension = source_.text_number();
      const auto number = source_.text_integer();
      const std::string name = source_.quoted();
      if (dimension == 2) mesh_.group_names[name] = number;
    }
  }

  /// Which physical group each geometric surface belongs to.
  void read_entities() {
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = source_.size();
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) read_entity(dimension);
  }
  void read_entity(std::size_t dimension) {
    const int tag = source_.integer();
    for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) source_.real();
    for (std::size_t left = source_.size(), first = left; left > 0; --left)
      if (const int group = source_.integer(); left == first && dimension == 2) surface_group_[tag] = group;
    if (dimension == 0) return;
    for (std::size_t left = source_.size(); left > 0; --left) source_.integer();
  }

  void read_nodes_2() {
    const std::int64_t count = source_.text_integer();
    source_.end_line();
    for (std::int64_t i = 0; i < count; ++i) {
      const auto tag = static_cast<std::size_t>(source_.integer());
      read_node(tag);
    }
  }
  void read_nodes_4() {
    const std::size_t blocks = source_.size();
    for (int i = 0; i < 3; ++i) source_.size();
    for (std::size_t block = 0; block < blocks; ++block) {
      const int dimension = source_.integer();
      source_.integer();
      const bool parametric = source_.integer() != 0;
      std::vector<std::size_t> tags(source_.count());
      for (std::size_t& tag : tags) tag = source_.size();
      for (const std::size_t tag : tags) {
        read_node(tag);
        for (int i = 0; parametric && i < dimension; ++i) source_.real();
      }
    }
  }
  void read_node(std::size_t tag) {
    Vec3 x;
    for (double& coordinate : x) coordinate = source_.real();
    if (!node_index_.emplace(tag, static_cast<int>(nodes_.size())).second)
      source_.fail(fmt::format("node {} occurs twice", tag));
    nodes_.push_back(x);
  }

  void read_elements_2() {
    const std::int64_t count = source_.text_integer();
    source_.end_line();
    for (std::int64_t done = 0; done < count;) {
      int tag = source_.binary() ? 0 : source_.integer();
      const int type = source_.integer(), in_block = source_.binary() ? source_.integer() : 1,
                labels = source_.integer();
      for (int i = 0; i < in_block; ++i, ++done) {
        if (source_.binary()) tag = source_.integer();
        int group = 0;
        for (int label = 0; label < labels; ++label)
          if (const int value = source_.integer(); label == 0) group = value;
        read_element(type, tag, group, [&] { return static_cast<std::size_t>(source_.integer()); });
      }
    }
  }
  void read_elements_4() {
    const std::size_t blocks = source_.size();
    for (int i = 0; i < 3; ++i) source_.size();
    for (std::size_t block = 0; block < blocks; ++block) {
      const int dimension = source_.integer(), entity = source_.integer(), type = source_.integer();
      const auto found = surface_group_.find(entity);
      const int group = dimension == 2 && found != surface_group_.end() ? found->second : 0;
      for (std::size_t left = source_.size(); left > 0; --left) {
        const auto tag = static_cast<int>(source_.size());
        read_element(type, tag, group, [&] { return source_.size(); });
      }
    }
  }

  template <class NextNode>
  void read_element(int type, int tag, int group, const NextNode& next_node) {
    static const std::map<int, int> node_count{{gmsh_line, 2},        {gmsh_triangle, 3}, {gmsh_quadrangle, 4},
                                               {gmsh_tetrahedron, 4}, {gmsh_prism, 6},    {gmsh_point, 1}};
    const auto count = node_count.find(type);
    if (count == node_count.end())
      source_.fail(fmt::format(
          "element {} is of Gmsh type {}: only linear tetrahedra, prisms and surface elements can be read", tag, type));
    std::array<int, 6> n{};
    for (int i = 0; i < count->second; ++i) {
      const std::size_t node = next_node();
      const auto found = node_index_.find(node);
      if (found == node_index_.end())
        source_.fail(fmt::format("element {} names node {}, which does not exist", tag, node));
      n[static_cast<std::size_t>(i)] = found->second;
    }
    if (type == gmsh_tetrahedron) mesh_.tetrahedra.push_back({n[0], n[1], n[2], n[3]});
    if (type == gmsh_prism) mesh_.prisms.push_back(n);
    if (type == gmsh_triangle || type == gmsh_quadrangle) add_triangle({n[0], n[1], n[2]}, group);
    if (type == gmsh_quadrangle) add_triangle({n[0], n[2], n[3]}, group);
  }
  void add_triangle(const Triangle& triangle, int group) {
    mesh_.triangles.push_back(triangle);
    mesh_.triangle_labels["physical"].push_back(group);
  }

  void take_points() {
    mesh_.points.resize(3, static_cast<Eigen::Index>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size(); ++i) mesh_.points.col(static_cast<Eigen::Index>(i)) = nodes_[i];
  }

  GmshSource source_;
  MeshFile mesh_;
  double version_ = 0;
  std::unordered_map<std::size_t, int> node_index_;
  std::vector<Vec3> nodes_;
  std::map<int, int> surface_group_;
};

}  // namespace

MeshFile read_gmsh(const std::filesystem::path& path) {
  return GmshReader(path).read();
}

}  // namespace tether
