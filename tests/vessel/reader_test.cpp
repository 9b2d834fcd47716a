#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/mesh/mesh_assertions.hpp"
#include "tests/vessel/gmsh_text.hpp"
#include "vessel/faces.hpp"
#include "vessel/mesh_file.hpp"

namespace tether {
namespace reader_test {

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nhas not: " << part;
}

/// A surface of three points and one triangle.
std::string ply(const std::string& nodes) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
         "1\n"
         "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 " +
         nodes + "\n";
}

TEST(Gmsh, AllVersionsGiveTheSameBox) {
  const TemporaryFolder folder;
  const BoxMesh box = box_mesh({1, 2, 3}, {2, 1, 3});
  for (const std::string& content :
       {gmsh_4_1(box, false), gmsh_4_1(box, true), gmsh_2_2(box, false), gmsh_2_2(box, true)}) {
    const MeshFile mesh = read_mesh_file(folder.file("box.msh", content));
    EXPECT_EQ(mesh.points, box.points);
    EXPECT_EQ(mesh.tetrahedra, box.tetrahedra);
    EXPECT_EQ(mesh.group_names.at("side 3"), 103);
    const FaceFinder finder(mesh, "unused");
    for (std::size_t i = 0; i < 6; ++i)
      for (const std::string& label : {"side " + std::to_string(i), std::to_string(100 + i)}) {
        const std::vector<Triangle> side = finder.find({{}, label}, 1);
        EXPECT_EQ(side.size(), box.sides[i].triangles.size());
        EXPECT_LT((total_area_vector(mesh.points, side) - total_area_vector(box.points, box.sides[i].triangles)).norm(),
                  1e-12);
      }
  }
}

TEST(Gmsh, PrismsAndQuadranglesAndUnusedNodes) {
  const TemporaryFolder folder;
  const MeshFile mesh =
      read_mesh_file(folder.file("prism.msh",
                                 "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n"
                                 "1 9 9 9\n2 0 0 0\n3 0 1 0\n4 1 0 0\n5 0 0 1\n6 0 1 1\n7 1 0 1\n$EndNodes\n$Elements\n"
                                 "3\n1 15 2 0 1 1\n2 6 2 5 1 2 3 4 5 6 7\n3 3 2 8 1 2 3 6 5\n$EndElements\n"));
  EXPECT_EQ(mesh.points.cols(), 6);
  ASSERT_EQ(mesh.prisms.size(), 1u);
  EXPECT_NEAR(total_volume(mesh.points, split_into_tetrahedra(mesh.prisms)), 0.5, 1e-15);  // given upside down
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(total_area(mesh.points, FaceFinder(mesh, "").find({{}, "8"}, 1)), 1, 1e-15);
}

TEST(Gmsh, MistakesAreNamedWithTheirLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& content) {
    return message_of([&] { read_mesh_file(folder.file("bad.msh", content)); });
  };
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  expect_part(message("$MeshFormat\n4 0 8\n$EndMeshFormat\n"), "bad.msh:2: Gmsh format 4: must be 2.x or 4.1");
  expect_part(message("hello\n"), "$MeshFormat was expected, hello found");
  expect_part(message(head + "$Nodes\n2\n1 0 0 0\n2 0 x 0\n$EndNodes\n"),
              "bad.msh:7: \"x\" found where a number was expected");
  expect_part(message(head + "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 11 2 0 1 1 1 1\n$EndElements\n"),
              "element 1 is of Gmsh type 11");
  expect_part(message(head + "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 4 2 0 1 1 1 1 2\n$EndElements\n"),
              "element 1 names node 2, which does not exist");
  expect_part(message(head + "$Nodes\n1\n1 0 0 0\n1 0 0 1\n"), "$EndNodes was expected, 1 found");
  expect_part(message(head + "$Nodes\n5\n1 0 0 0\n"), "the file ends too early");
}

std::string binary_stl(const BoxMesh& box) {
  std::string content(80, ' ');
  content.replace(0, 5, "solid");
  const auto add = [&](const auto& value) { content.append(reinterpret_cast<const char*>(&value), sizeof value); };
  std::vector<Triangle> all;
  tether::append(all, {box.sides.begin(), box.sides.end()});
  add(static_cast<std::uint32_t>(all.size()));
  for (const Triangle& t : all) {
    for (int i = 0; i < 3; ++i) add(0.0f);
    for (const int node : t)
      for (const double x : box.points.col(node)) add(static_cast<float>(x));
    add(std::uint16_t{0});
  }
  return content;
}

std::string text_stl(const BoxMesh& box) {
  std::string content = "solid box\n";
  for (const Patch& side : box.sides)
    for (const Triangle& t : side.triangles) {
      content += "facet normal 0 0 0\n outer loop\n";
      for (const int node : t)
        content += fmt::format("  vertex {} {} {}\n", box.points(0, node), box.points(1, node), box.points(2, node));
      content += " endloop\nendfacet\n";
    }
  return content + "endsolid box\n";
}

TEST(Stl, CornersAreMergedAndFoundInTheVolume) {
  const TemporaryFolder folder;
  const BoxMesh box = box_mesh({1, 2, 3}, {2, 1, 3});
  MeshFile volume;
  volume.name = "volume";
  volume.points = box.points;
  volume.tetrahedra = box.tetrahedra;
  const FaceFinder finder(volume, "");
  for (const auto& content : {binary_stl(box), text_stl(box)}) {
    const auto path = folder.file("box.stl", content);
    const MeshFile surface = read_mesh_file(path);
    EXPECT_EQ(surface.points.cols(), 24);  // all nodes of this box are on its surface
    EXPECT_TRUE(open_edges(surface.triangles).empty());
    const std::vector<Triangle> found = finder.find({path, {}}, 1);
    EXPECT_EQ(found.size(), surface.triangles.size());
    EXPECT_LT(total_area_vector(box.points, found).norm(), 1e-12);
  }
  expect_part(message_of([&] { finder.find({folder / "box.stl", {}}, 2); }), "is no node of volume: the nearest lies");
}

TEST(Stl, MistakesAreNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& content) {
    return message_of([&] { read_mesh_file(folder.file("bad.stl", content)); });
  };
  expect_part(message("something"), "neither text STL");
  expect_part(message("solid x\nvertex 0 0\n"), "bad.stl:2: three coordinates");
  expect_part(message("solid x\nvertex 0 0 0 7\n"), "bad.stl:2: '7' stands behind three coordinates");
  expect_part(message("solid x\nvertex 0 0 0\n"), "the last facet has 1 corners");
  expect_part(message("solid x\nendsolid\n"), "holds no triangle");
  expect_part(message("solid x\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"),
              "bad.stl: ends without \"endsolid\": cut short?");
}

TEST(Stl, ABinaryFileCutShortOrWithoutANumberIsNamed) {
  const TemporaryFolder folder;
  std::string content = binary_stl(box_mesh({1, 1, 1}, {1, 1, 1}));
  const auto message = [&] { return message_of([&] { read_mesh_file(folder.file("box.stl", content)); }); };
  const std::string whole = content;
  content.resize(content.size() - 20);
  expect_part(message(), fmt::format("12 facets take {} bytes, it has {}: cut short?", whole.size(), content.size()));
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    content = whole;
    std::memcpy(content.data() + 84 + 3 * 50 + 12 + 4, &bad, sizeof bad);  // y of the first corner of facet 3
    expect_part(message(), "box.stl: facet 3 (from 0) has a corner (");
    expect_part(message(), fmt::format(", {}, ", bad));
  }
}

TEST(ReadMeshFile, KnowsExtensionsInCapitals) {
  const TemporaryFolder folder;
  const BoxMesh box = box_mesh({1, 1, 1}, {1, 1, 1});
  EXPECT_EQ(read_mesh_file(folder.file("BOX.STL", binary_stl(box))).triangles.size(), 12U);
  EXPECT_EQ(read_mesh_file(folder.file("A.PLY", ply("0 1 2"))).triangles.size(), 1U);
}

TEST(Vtk, LegacyFilesAreRead) {
  const TemporaryFolder folder;
  const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\n";
  const std::string points = "POINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n";
  const MeshFile grid =
      read_mesh_file(folder.file("grid.vtk", head + "DATASET UNSTRUCTURED_GRID\n" + points +
                                                 "CELLS 2 9\n4 0 1 2 3\n3 0 2 1\nCELL_TYPES 2\n10\n5\nCELL_DATA "
                                                 "2\nSCALARS part int 1\nLOOKUP_TABLE default\n3\n4\n"));
  EXPECT_EQ(grid.tetrahedra, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
  EXPECT_EQ(grid.triangle_labels.at("part"), (std::vector<std::int64_t>{4}));
  const MeshFile surface =
      read_mesh_file(folder.file("surface.vtk", head + "DATASET POLYDATA\n" + points + "POLYGONS 1 5\n4 0 1 2 3\n"));
  EXPECT_EQ(surface.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Vtk, ACellThatNamesNoPointIsNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& content) {
    return message_of([&] { read_mesh_file(folder.file(name, content)); });
  };
  EXPECT_EQ(message("good.ply", ply("0 1 2")), "accepted");
  expect_part(message("a.ply", ply("0 1 99")),
              "a.ply:13: cell 0 (from 0) names point 99: the file has 3, numbered from 0");
  expect_part(message("a.ply", ply("0 -1 2")), "a.ply:13: cell 0 (from 0) names point -1");
  const auto vtp = [](const std::string& nodes) {
    return "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"3\" "
           "NumberOfPolys=\"2\"><Points>"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
           "0</DataArray></Points>"
           "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 " +
           nodes +
           "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6</DataArray></Polys></Piece>"
           "</PolyData></VTKFile>\n";
  };
  EXPECT_EQ(message("good.vtp", vtp("2 1 0")), "accepted");
  expect_part(message("a.vtp", vtp("0 1 7000000")), "a.vtp: cell 1 (from 0) names point 7000000: the file has 3");
  expect_part(message("a.vtk",
                      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 "
                      "0 0 0 1 0\nCELLS 1 4\n3 0 1 3\nCELL_TYPES 1\n5\n"),
              "a.vtk:8: cell 0 (from 0) names point 3: the file has 3");
  expect_part(message("word.vtk",
                      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 none 0 1 0\n"
                      "POLYGONS 1 4\n3 0 1 2\n"),
              "word.vtk:6: \"none\" found where a number was expected");
  std::string without = ply("0 1 2");
  without.replace(without.find("\n1 0 0\n"), 7, "\n1 0 nan\n");
  expect_part(message("nan.ply", without), "nan.ply:11: the coordinate nan is not a finite number");
}

TEST(Obj, WordsAreReadToTheirEnd) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& third, const std::string& face) {
    const auto file = folder.file("x.obj", "# one\nv 0 0 0 1\nv 1 0 0 # two\n" + third + "\n" + face + "\n");
    return message_of([&] { read_mesh_file(file); });
  };
  EXPECT_EQ(message("v 0 +1 1e-3 0.5 0.5 0.5\r", "f 1/7/8 2//3 -1/\r"), "accepted");
  expect_part(message("v 0 1 3,333", "f 1 2 3"),
              "x.obj:4: '3,333' is not a number (numbers have points, not commas: 0.5)");
  expect_part(message("v 0 1 0 garbage", "f 1 2 3"), "x.obj:4: 'garbage' is not a number");
  expect_part(message("v 0 1 nan", "f 1 2 3"), "x.obj:4: 'nan' is not a number");
  expect_part(message("v 0 1", "f 1 2 3"), "x.obj:4: three coordinates were expected behind v");
  for (const std::string node : {"3e1abc", "3.0", "3,1", "/3", "3/x", "99999999999"})
    expect_part(message("v 0 1 0", "f 1 2 " + node),
                "x.obj:5: '" + node + "' is no node: must be a number, or numbers with slashes between them");
  expect_part(message("V 0 1 0", "f 1 2 3"), "x.obj:4: the line begins with V: must be a small letter");
  expect_part(message("v 0 1 0\nF 1 2 3", "f 1 2 3"), "x.obj:5: the line begins with F: must be a small letter");
}

TEST(Vtk, MistakesAreNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& content) {
    return message_of([&] { read_mesh_file(folder.file(name, content)); });
  };
  expect_part(message("x.vtu", "no xml"), "x.vtu:1: a tag was expected");
  expect_part(message("x.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"),
              "is not a VTK file with an unstructured grid");
  expect_part(message("x.step", ""), "unknown kind of mesh file: must be .vtu, .vtp, .vtk, .ply, .msh, .stl or .obj");
  expect_part(message("x.obj", ""), "holds no face");
  expect_part(message_of([] { read_mesh_file("/no/such/mesh.vtu"); }), "/no/such/mesh.vtu: no such file");
  expect_part(message_of([] { read_mesh_file("/dev/zero"); }), "/dev/zero: is not a file");
  expect_part(message("hexahedron.vtk",
                      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n0 0 0 1 0 0 1 "
                      "1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
                      "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n"),
              "cell 0 is of VTK type 12");
}

}  // namespace reader_test
}  // namespace tether
