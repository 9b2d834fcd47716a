#pragma once

#include <cstdint>
#include <sstream>
#include <string>

#include "tests/mesh/box.hpp"

/// A box as Gmsh writes it: nodes 10, 20, 30 ..., side i in geometric surface 7 + i and physical surface 100 + i.
namespace tether {

/// Numbers as text, with a blank behind, or as bytes.
class GmshText {
 public:
  explicit GmshText(bool binary) : binary_(binary) {}
  GmshText& integer(int x) { return number<std::int32_t>(x); }
  GmshText& size(std::size_t x) { return number<std::uint64_t>(x); }
  GmshText& real(double x) { return number<double>(x); }
  GmshText& line(const std::string& text) {
    out_ << text << '\n';
    return *this;
  }
  std::string content() const { return out_.str(); }

 private:
  template <class Number, class Given>
  GmshText& number(Given x) {
    const auto value = static_cast<Number>(x);
    if (binary_) {
      out_.write(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      out_.precision(17);
      out_ << value << ' ';
    }
    return *this;
  }
  bool binary_;
  std::ostringstream out_;
};

inline GmshText gmsh_head(const std::string& version, bool binary) {
  GmshText out(binary);
  out.line("$MeshFormat").line(version + (binary ? " 1 8" : " 0 8"));
  if (binary) out.integer(1).line("");
  out.line("$EndMeshFormat").line("$PhysicalNames").line("7");
  for (int i = 0; i < 6; ++i) out.line("2 " + std::to_string(100 + i) + " \"side " + std::to_string(i) + "\"");
  out.line("3 100 \"side 0\"").line("$EndPhysicalNames").line("$Comments").line("anything 12").line("$EndComments");
  return out;
}

inline int gmsh_tag(int node) {
  return 10 * (node + 1);
}

inline std::string gmsh_4_1(const BoxMesh& box, bool binary) {
  GmshText out = gmsh_head("4.1", binary);
  out.line("$Entities").size(0).size(0).size(6).size(1);
  for (int i = 0; i < 6; ++i) {
    out.integer(7 + i);
    for (int k = 0; k < 6; ++k) out.real(0.5);
    out.size(1).integer(100 + i).size(1).integer(3);
  }
  out.integer(1);
  for (int k = 0; k < 6; ++k) out.real(0.5);
  out.size(0).size(0).line("").line("$EndEntities").line("$Nodes");
  const auto nodes = static_cast<std::size_t>(box.points.cols());
  out.size(1).size(nodes).size(10).size(10 * nodes).integer(3).integer(1).integer(0).size(nodes);
  for (int i = 0; i < box.points.cols(); ++i) out.size(static_cast<std::size_t>(gmsh_tag(i)));
  for (const double x : box.points.reshaped()) out.real(x);
  out.line("").line("$EndNodes").line("$Elements").size(7).size(0).size(1).size(9);
  std::size_t tag = 1;
  for (int i = 0; i < 6; ++i) {
    const auto& triangles = box.sides[static_cast<std::size_t>(i)].triangles;
    out.integer(2).integer(7 + i).integer(2).size(triangles.size());
    for (const Triangle& t : triangles) {
      out.size(tag++);
      for (const int node : t) out.size(static_cast<std::size_t>(gmsh_tag(node)));
    }
  }
  out.integer(3).integer(1).integer(4).size(box.tetrahedra.size());
  for (const Tetrahedron& t : box.tetrahedra) {
    out.size(tag++);
    for (const int node : t) out.size(static_cast<std::size_t>(gmsh_tag(node)));
  }
  out.line("").line("$EndElements");
  return out.content();
}

inline std::string gmsh_2_2(const BoxMesh& box, bool binary) {
  GmshText out = gmsh_head("2.2", binary);
  out.line("$Nodes").line(std::to_string(box.points.cols()));
  for (int i = 0; i < box.points.cols(); ++i) {
    out.integer(gmsh_tag(i));
    for (const double x : box.points.col(i)) out.real(x);
  }
  std::size_t count = box.tetrahedra.size();
  for (const Patch& side : box.sides) count += side.triangles.size();
  out.line("").line("$EndNodes").line("$Elements").line(std::to_string(count));
  int tag = 1;
  const auto add = [&](int type, int group, const auto& nodes) {
    if (binary) out.integer(type).integer(1).integer(2).integer(tag++);
    if (!binary) out.integer(tag++).integer(type).integer(2);
    out.integer(group).integer(1);
    for (const int node : nodes) out.integer(gmsh_tag(node));
  };
  for (int i = 0; i < 6; ++i)
    for (const Triangle& t : box.sides[static_cast<std::size_t>(i)].triangles) add(2, 100 + i, t);
  for (const Tetrahedron& t : box.tetrahedra) add(4, 100, t);
  out.line("").line("$EndElements");
  return out.content();
}

}  // namespace tether
