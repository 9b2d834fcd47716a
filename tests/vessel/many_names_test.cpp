#include <gtest/gtest.h>

#include <string>

#include "tests/io/temporary_folder.hpp"
#include "tests/vessel/good_files.hpp"
#include "vessel/mesh_file.hpp"

namespace tether {
namespace damaged_files_test {

/// `one` with the numbers from 0 on in place of #.
std::string numbered(int count, const std::string& one) {
  std::string all;
  for (int i = 0; i < count; ++i) all += std::string(one).replace(one.find('#'), 1, std::to_string(i));
  return all;
}

/// Short files of which the parsers, VTK's and ours, would take minutes: each name is looked for among the others.
TEST(DamagedFiles, WithMoreNamesThanAnyProgramWritesAreRefused) {
  const std::string in_head = numbered(1001, "property float p#\n"), elements = numbered(1001, "element e# 0\n");
  expect_messages("a.ply", ply,
                  {{"element face", in_head + "element face", "has more than 1000 elements and properties"},
                   {"element face", elements + "element face", "has more than 1000 elements and properties"}});
  std::string entities;
  for (int i = 0; i < 20'000; ++i) entities += "&amp;";
  const std::string arrays =
      numbered(1001, "<DataArray type=\"Int8\" Name=\"a#\" format=\"ascii\" NumberOfTuples=\"1\">7 8</DataArray>\n");
  expect_messages(
      "a.vtp", vtp,
      {{"<PolyData>", "<PolyData" + numbered(101, " a#=\"1\"") + ">", "a.vtp:3: a tag has more than 100 attributes"},
       {"<PolyData>", "<PolyData a=\"" + entities + "\">", "a.vtp:3: the value of a has more than 65536 bytes"},
       {"<PolyData>", "<PolyData>" + numbered(250'000, "<X# />"), "a.vtp:3: has more than 250000 tags"},
       {"<CellData>", "<CellData>" + arrays, "CellData has more than 1000 arrays"},
       {"<PolyData>", "<PolyData><FieldData>" + arrays + "</FieldData>", "FieldData has more than 1000 arrays"}});
}

/// Photogrammetry writes tens of properties, solvers tens of arrays.
TEST(DamagedFiles, WithManyNamesAreRead) {
  const TemporaryFolder folder;
  std::string many = ply;
  many.replace(many.find("element face"), 0, numbered(90, "property float p#\n"));
  for (const std::string point : {"0 0 0\n", "1 0 0.5\n", "0 1 0\n", "1 1 0\n"})
    many.replace(many.find("\n" + point) + point.size(), 0, numbered(90, " #"));
  EXPECT_EQ(message_of([&] { read_mesh_file(folder.file("a.ply", many)); }), "accepted");
  many = vtp;
  const std::string arrays = numbered(900, "<DataArray type=\"Int8\" Name=\"a#\" format=\"ascii\">7 8</DataArray>\n");
  many.replace(many.find("</CellData>"), 0, arrays);
  EXPECT_EQ(message_of([&] { read_mesh_file(folder.file("a.vtp", many)); }), "accepted");
}

}  // namespace damaged_files_test
}  // namespace tether
