#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <vector>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "tests/io/less_memory.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/vessel/good_files.hpp"
#include "vessel/mesh_file.hpp"
#include "vessel/readers.hpp"

/// Whatever is wrong with a file: it is read, or refused with one InputError.
namespace tether {
namespace damaged_files_test {

/// As broken downloads leave them: their length is there, and zeros.
TEST(DamagedFiles, LargerThanAnyVesselAreNotRead) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.stl", "a.ply", "a.obj", "a.msh", "a.vtk", "a.vtp"}) {
    std::filesystem::resize_file(folder.file(name, ""), 300'000'000);
    EXPECT_EQ(message_of([&] { read_mesh_file(folder / name); }),
              (folder / name).string() + ": has 300 MB: larger than any such file that is read here (250 MB)");
  }
  std::filesystem::resize_file(folder.file("a.csv", ""), 300'000'000);
  EXPECT_NE(message_of([&] { CsvTable{folder / "a.csv"}; }).find("(100 MB)"), std::string::npos);
}

TEST(DamagedFiles, OfPlyAreNamed) {
  expect_messages(
      "a.ply", ply,
      {{"ply\n", "plx\n", "a.ply:1: is no PLY file"},
       {ply.substr(ply.find("element"), ply.find("end_header") - ply.find("element")), "",
        "a.ply:3: the header states no elements"},
       {"ply\n", "...", "a.ply:1: is no PLY file"},
       {"format ascii 1.0\n", "", "states no format"},
       {"ascii", "asci", "a.ply:2: \"asci\" found where ascii, binary_little_endian or binary_big_endian was expected"},
       {"1.0", "2.0", "a.ply:2: \"2.0\" found"},
       {"ascii", "binary_little_endian", "a.ply: byte "},
       {"vertex 4", "vertex 99999999999", "99999999998 vertex are stated, "},
       {"vertex 4", "vertex -4", "a.ply:3: \"-4\" found where the number of vertex was expected"},
       {"vertex 4", "vertex", "a.ply:3: the number of vertex is missing"},
       {"element face 2", "element vertex 1\nproperty float x\nelement face 2",
        "a.ply:7: a second element vertex: must be one"},
       {"end_header", "element face 1\nproperty list uchar int vertex_indices\nend_header",
        "a.ply:9: a second element face: must be one"},
       {"format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n", "a.ply:3: a second format: must be one"},
       {"property float y", "property float x", "a.ply:5: vertex has two properties x"},
       {"vertex 4", "vertex 3", "a.ply:13: "},
       {"vertex 4", "vertex 5", "a.ply:14: more numbers than vertex 4 (from 0) has"},
       {"element vertex", "element vortex", "faces stand before the vertices"},
       {"element face 2", "element face 9999999999", "9999999998 face are stated, "},
       {"element face 2", "element face 0", "a.ply:14: 0 face are stated, 16 bytes stand behind the last"},
       {"element face 2", "element face 3", "cut short"},
       {"property float x", "property flaot x", "a.ply:4: \"flaot\" found where a type of numbers"},
       {"property float x", "property list uchar int x", "no property x of one number"},
       {"property float x", "property", "a.ply:4: the file or the line ends"},
       {"list uchar", "list float", "a.ply:8: the length of a list must be an integer"},
       {"int vertex_indices", "float vertex_indices", "no list of integers vertex_indices"},
       {"int vertex_indices", "int nodes", "no list of integers vertex_indices"},
       {"end_header", "end_heder", "a.ply:9: \"end_heder\" found"},
       {"end_header", "...", "a.ply:9: the file or the line ends where format"},
       {"1 0 0.5", "1 0", "a.ply:11: vertex 1 (from 0) ends before its z"},
       {"1 0 0.5", "1 0 x", "a.ply:11: \"x\" found where a number was expected"},
       {"1 0 0.5", "1 0 nan", "a.ply:11: the coordinate nan is not a finite number"},
       {"1 0 0.5", "1 0 1e999", "a.ply:11: the coordinate inf is not a finite number"},
       {"3 0 1 2", "-3 0 1 2", "a.ply:14: the list vertex_indices of face 0 (from 0) has -3 values"},
       {"3 0 1 2", "4 0 1 2", "a.ply:14: face 0 (from 0) ends before its vertex_indices"},
       {"3 0 1 2", "2 0 1", "a.ply:14: face 0 (from 0) has 2 nodes"},
       {"3 0 1 2", "2 0 1 2", "a.ply:14: more numbers than face 0 (from 0) has"},
       {"3 0 1 2", "99999999 0 1 2", "a.ply:14: 99999998 vertex_indices are stated"},
       {"3 0 1 2", "3 0 1 99999999", "a.ply:14: cell 0 (from 0) names point 99999999: the file has 4"},
       {"3 0 1 2", "3 0 1 -5", "a.ply:14: cell 0 (from 0) names point -5"},
       {"3 0 1 2", "3 0 1 99999999999999999999", "a.ply:14: \"99999999999999999999\" found where an integer"},
       {"3 0 1 2", "3 0 1 1.5", "a.ply:14: \"1.5\" found where an integer was expected"},
       {"element face 2", "element face 1",
        "a.ply:15: 1 face are stated, 8 bytes stand behind the last: must be as many"},
       {"3 1 3 2\n", "3 1 3 2\ncomment of one\n# of another\n\n 3\n", "a.ply:19: 2 face are stated, 2 bytes stand"},
       {"3 1 3 2", "...", "cut short"}});
  const TemporaryFolder folder;
  EXPECT_EQ(message_of([&] { read_mesh_file(folder.file("a.ply", ply + "\n \ncomment behind\n")); }), "accepted");
}

TEST(DamagedFiles, OfLegacySurfacesAreNamed) {
  expect_messages(
      "a.vtk", surface_vtk,
      {{"# vtk", "# vkt", "a.vtk:1: is no VTK file"},
       {"3.0", "9.0", "a.vtk:1: version 9.0: must be 1 to 5.1"},
       {"ASCII", "ASKII", "a.vtk:3: \"ASKII\" found where ASCII or BINARY was expected"},
       {"ASCII", "BINARY", "a.vtk: byte "},
       {"POLYDATA", "UNSTRUCTURED_GRID", "a.vtk:10: cells of a surface stand where there is no DATASET POLYDATA"},
       {"POLYDATA", "RECTILINEAR_GRID", "a.vtk:4: is not a VTK file with an unstructured grid or a surface"},
       {"POINTS 4", "POINTS 999999999999", "999999999999 points are stated, "},
       {"POINTS 4", "POINTS -3", "a.vtk:5: \"-3\" found where the number of points was expected"},
       {"POINTS 4", "POINTS 3", "a.vtk:9: \"1\" found where a section"},
       {"POINTS 4", "POINTS 5", "a.vtk:10: \"POLYGONS\" found where a number was expected"},
       {"float", "flaot", "a.vtk:5: \"flaot\" found where a type of numbers"},
       {"1 0 0.5", "1 0 inf", "a.vtk:7: the coordinate inf is not a finite number"},
       {"POLYGONS 2 8", "POLYGONS 99999999999 8", "a.vtk:10: 99999999998 cells are stated, "},
       {"POLYGONS 2 8", "POLYGONS 2 99999999", "a.vtk:10: 99999998 integers of the cells are stated, "},
       {"POLYGONS 2 8", "POLYGONS 2 9", "a.vtk:12: the cells have 8 integers, 9 are stated"},
       {"POLYGONS 2 8", "POLYGONS 2 7",
        "a.vtk:12: cell 1 (from 0) has 3 nodes, where 3 of the 7 integers stated are left"},
       {"POLYGONS 2 8", "POLYGONS", "a.vtk:11: "},
       {"POLYGONS", "LINEZ", "a.vtk:10: \"linez\" found where a section"},
       {"CELL_DATA", "POINTS 1 float\n0 0 0\nCELL_DATA", "a.vtk:13: a second section points: must be one"},
       {"CELL_DATA", "POLYGONS 1 4\n3 0 1 2\nCELL_DATA", "a.vtk:13: a second section polygons: must be one"},
       {"CELL_DATA", "DATASET UNSTRUCTURED_GRID\nCELL_DATA", "a.vtk:13: a second section dataset: must be one"},
       {"3 0 1 2", "-3 0 1 2", "a.vtk:11: cell 0 (from 0) has -3 nodes"},
       {"3 0 1 2", "4 0 1 2", "a.vtk:12: cell 1 (from 0) has 1 nodes"},
       {"3 0 1 2", "3 0 1 99999999", "a.vtk:11: cell 0 (from 0) names point 99999999"},
       {"3 0 1 2", "3 0 1 -5", "a.vtk:11: cell 0 (from 0) names point -5"},
       {"CELL_DATA 2", "CELL_DATA 3", "a.vtk:13: data of 3 cells, the file has 2 before them"},
       {"CELL_DATA 2\n", "", "a.vtk:14: an array stands before CELL_DATA or POINT_DATA"},
       {"part int 1", "part int 99999999999", "array part of 2 tuples of 99999999999"},
       {"part int 1", "part int 4611686018427387904", "array part of 2 tuples of 4611686018427387904"},
       {"LOOKUP_TABLE", "LOOKDOWN", "\"LOOKDOWN\" found where LOOKUP_TABLE was expected"},
       {"more 1", "more 99999999999", "a.vtk:22: \"VECTORS\" found where the number of tuples was expected"},
       {"face 1 2", "face 1 1", "\"2\" found where a section"},
       {"face 1 2 int\n1 2", "face 1 1 int\n1", "array face has 1 values: the file has 2 cells"},
       {"face 1 2 int", "face 1 2 variant", "\"variant\" found where a type of an array that can be read was expected"},
       {"3 3 3", "...", "cut short"}});
}

TEST(DamagedFiles, OfLegacyGridsAreNamed) {
  expect_messages(
      "a.vtk", grid_vtk,
      {{"5.1", "4.2", "a.vtk:14: \"OFFSETS\" found where an integer was expected"},
       {"CELLS 3", "CELLS 99999999999", "99999999998 offsets are stated, "},
       {"CELLS 3 7", "CELLS 3 99999999999", "the last offset is 7: 99999999999 nodes are stated"},
       {"CELLS 3 7", "CELLS 2 7", "the last offset is 4: 7 nodes are stated"},
       {"OFFSETS", "OFSETS", "\"OFSETS\" found where OFFSETS was expected"},
       {"OFFSETS vtktypeint64", "OFFSETS double", "a type of integers was expected"},
       {"0 4 7", "0 9 7", "offset 1 (from 0) is 9"},
       {"0 4 7", "0 4 3", "offset 2 (from 0) is 3, behind 4, of 7 nodes"},
       {"0 4 7", "1 4 7", "offset 0 (from 0) is 1"},
       {"0 4 7", "0 -4 7", "offset 1 (from 0) is -4"},
       {"0 1 2 3", "0 1 2 4", "cell 0 (from 0) names point 4: the file has 4"},
       {"CELL_TYPES 2", "CELL_TYPES 3", "3 types of cells, the file has 2 cells before them"},
       {"10\n5", "10\n10", "cell 1 (from 0), of VTK type 10, has 3 nodes"},
       {"10\n5", "12\n5", "cell 0 is of VTK type 12"},
       {"CELL_TYPES", "...", "2 cells have 0 types: cut short?"},
       {"POINT_DATA", "POINTS 1 double\n0 0 0\nPOINT_DATA", "a.vtk:22: a second section points: must be one"},
       {"POINT_DATA", "CELLS 0 0\nPOINT_DATA", "a.vtk:22: a second section cells: must be one"},
       {"POINT_DATA", "CELL_TYPES 2\n5 5\nPOINT_DATA", "a.vtk:22: a second section cell_types: must be one"},
       {"1 2 3 4", "1 2 3", "cut short"}});
}

TEST(DamagedFiles, OfXmlSurfacesAreNamed) {
  expect_messages(
      "a.vtp", vtp,
      {{"VTKFile", "VKTFile", "a.vtp:2: is no VTK file"},
       {"type=\"PolyData\"", "type=\"ImageData\"", "a.vtp:2: type=\"ImageData\": must be PolyData"},
       {"LittleEndian", "MiddleEndian", "byte_order=\"MiddleEndian\": must be LittleEndian, BigEndian"},
       {"UInt64", "UInt7", "header_type=\"UInt7\": must be UInt32, UInt64"},
       {"NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999999\"",
        "a.vtp:4: NumberOfPoints=\"99999999999\": the file has"},
       {"NumberOfPoints=\"4\"", "NumberOfPoints=\"-1\"", "a.vtp:4: NumberOfPoints=\"-1\": must be a number, 0 or more"},
       {"NumberOfPoints=\"4\"", "NumberOfPoints=\"5\"",
        "a.vtp:11: array Points of Points: 15 values are needed, it has 12"},
       {"NumberOfPoints=\"4\"", "NumberOfPoints=\"3\"",
        "a.vtp:11: array Points of Points: 9 values are stated by its piece, it has more"},
       {"NumberOfPoints=\"4\"", "NumberOfPoints=\"0\"", "has no points"},
       {"NumberOfPolys=\"2\"", "NumberOfPolys=\"9999999999\"", "a.vtp:4: NumberOfPolys=\"9999999999\""},
       {"NumberOfPolys=\"2\"", "NumberOfPolys=\"1\"",
        "a.vtp:23: array offsets of Polys: 1 values are stated by its piece, it has more: must be as many"},
       {"NumberOfPolys=\"2\"", "NumberOfPolys=\"3\"", "array offsets of Polys: 3 values are needed, it has 2"},
       {"NumberOfComponents=\"3\"", "NumberOfComponents=\"4294967296\"", "a.vtp:11: NumberOfComponents=\"4294967296\""},
       {"NumberOfComponents=\"3\"", "NumberOfComponents=\"0\"", "must be 1 to 1000"},
       {"NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"", "NumberOfComponents=\"2\": must be 3"},
       {"Float64", "Foo", "a.vtp:11: type=\"Foo\": no type of numbers that can be read"},
       {"format=\"ascii\"", "format=\"asci\"", "a.vtp:6: format=\"asci\": must be ascii, binary, appended"},
       {"format=\"ascii\"", "format=\"appended\"", "a.vtp:6: offset=\"\": must be a number, 0 or more"},
       {"format=\"ascii\"", "format=\"appended\" offset=\"7\"",
        "a.vtp:6: array part of CellData: its data are appended"},
       {"format=\"ascii\"", "format=\"binary\"", "a.vtp:6: array part of CellData: its data end in their header"},
       {"7 8", "4611686018427387904 8", "a.vtp:7: \"4611686018427387904\" found where a number (Int32) was expected"},
       {"7 8", "7 1.5", "a.vtp:7: \"1.5\" found where a number (Int32) was expected"},
       {" Name=\"part\"", "", "a.vtp:6: Name=\"\": an array of data must have one"},
       {"</DataArray>\n</CellData>", "</DataArray><DataArray type=\"Int8\" Name=\"part\" format=\"ascii\"/></CellData>",
        "a.vtp:8: Name=\"part\": occurs twice"},
       {"\"part\"", "\"part", "a.vtp:6: a tag is not whole"},
       {"1 0 0.5", "1 0 x", "a.vtp:13: \"x\" found where a number (Float64) was expected"},
       {"1 0 0.5", "1 0 inf", "has a coordinate that is not a finite number"},
       {"0 1 2\n", "0 1 99999\n", "cell 0 (from 0) names point 99999: the file has 4"},
       {"0 1 2\n", "0 1 -7\n", "cell 0 (from 0) names point -7"},
       {"3 6", "3 99999999999", "the nodes of cell 1 (from 0) end at 99999999999"},
       {"3 6", "3 4611686018427387904", "the nodes of cell 1 (from 0) end at 4611686018427387904"},
       {"3 6", "3 2", "the nodes of cell 1 (from 0) end at 2, those of the one before at 3"},
       {"3 6", "-3 6", "the nodes of cell 0 (from 0) end at -3"},
       {"3 6", "3 7", "array connectivity of Polys: 7 values are needed, it has 6"},
       {"3 6", "3 5", "array connectivity of Polys: 5 values are stated by its piece, it has more"},
       {"0 1 2\n1 3 2", "0 1 2\n1 3", "array connectivity of Polys: 6 values are needed, it has 5"},
       {"</Points>", "</Ponts>", "a.vtp:17: </Ponts> closes no open tag"},
       {"</Piece>", "...", "the file ends before </Piece>: cut short?"},
       {"</PolyData>", "</PolyData>\n<PolyData></PolyData>", "a.vtp:29: a second PolyData: must be one"},
       {"<Polys>", "<Polys></Polys>\n<Polys>", "a.vtp:19: a second Polys of a piece: must be one"},
       {"<Points>", "<Points></Points><Points>", "a.vtp:10: a second Points of a piece: must be one"},
       {"\"connectivity\"", "\"offsets\"", "a.vtp:23: a second array offsets of a piece: must be one"},
       {"<Polys>", "<!DOCTYPE x><Polys>", "a.vtp:18: no tag that a VTK file can have"}});
}

TEST(DamagedFiles, OfXmlGridsAreNamed) {
  expect_messages("a.vtu", vtu,
                  {{"NumberOfCells=\"2\"", "NumberOfCells=\"99999999999\"", "a.vtu:3: NumberOfCells=\"99999999999\""},
                   {"NumberOfCells=\"2\"", "NumberOfCells=\"0\"", "holds no cell"},
                   {"\"Int32\" Name=\"connectivity\"", "\"String\" Name=\"connectivity\"", "type=\"String\": no type"},
                   {"Name=\"offsets\"", "Name=\"faces\"", "a.vtu:13: polyhedra"},
                   {"Name=\"types\"", "Name=\"kinds\"", "is not a readable VTK file of its kind"},
                   {"4 7", "4 2000000000", "the nodes of cell 1 (from 0) end at 2000000000"},
                   {"10 5", "10 10", "cell 1 (from 0), of VTK type 10, has 3 nodes"},
                   {"10 5", "12 5", "cell 0 is of VTK type 12"},
                   {"10 5", "10", "array types of Cells: 2 values are needed, it has 1"}});
}

template <class Number>
std::string bytes_of(Number number, bool big) {
  std::string bytes(sizeof number, ' ');
  std::memcpy(bytes.data(), &number, sizeof number);
  return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string binary_ply(bool big) {
  std::string file = ply.substr(0, ply.find("end_header\n") + 11);
  file.replace(file.find("ascii"), 5, big ? "binary_big_endian" : "binary_little_endian");
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, .5f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) file += bytes_of(x, big);
  for (const std::int32_t x : {0, 1, 2, -3, 1, 3, 2})
    file += x < 0 ? std::string(1, '\3') : (x == 0 ? std::string(1, '\3') : "") + bytes_of(x, big);
  return file;
}

std::string binary_vtk() {
  std::string file = "# vtk DataFile Version 4.2\ntitle\nBINARY\nDATASET POLYDATA\nPOINTS 4 float\n";
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, .5f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) file += bytes_of(x, true);
  file += "\nPOLYGONS 2 8\n";
  for (const std::int32_t x : {3, 0, 1, 2, 3, 1, 3, 2}) file += bytes_of(x, true);
  return file + "\nCELL_DATA 2\nFIELD FieldData 2\nflag 1 2 bit\n\x80\ntext 1 2 string\n\xc2oh\xc0\n";
}

TEST(DamagedFiles, OfBinaryNumbersAreNamedWithTheirByte) {
  const auto face = [](std::int32_t a, bool big) { return bytes_of(a, big) + bytes_of(1, big) + bytes_of(2, big); };
  for (const bool big : {false, true})
    expect_messages("a.ply", binary_ply(big),
                    {{face(0, big), face(77, big), "names point 77"},
                     {face(0, big), "...", "a.ply: byte "},
                     {"\3" + face(0, big), "\xff" + face(0, big), "255 vertex_indices are stated"},
                     {"element face 2", "element face 1", "1 face are stated, 13 bytes stand behind the last"},
                     {bytes_of(.5f, big), bytes_of(NAN, big), "the coordinate nan is not a finite number"}});
  expect_messages("a.vtk", binary_vtk(),
                  {{bytes_of(3, true), bytes_of(-3, true), "a.vtk: byte 134: cell 0 (from 0) has -3 nodes"},
                   {bytes_of(.5f, true), bytes_of(NAN, true), "a.vtk: byte "},
                   {face(0, true), face(9, true), "names point 9"},
                   {"POLYGONS 2 8\n", "POLYGONS 2 8 ", "found where the end of the line was expected"},
                   {"1 2 bit", "1 9999 bit", "array flag of 9999 tuples"},
                   {"\xc2oh", "\xfeoh", "62 bytes are stated"}});
}

/// A surface or a grid as VTK writes it, with small blocks.
template <class Reader, class Writer>
std::string rewritten(const std::string& name, const std::string& text, int compressor, int mode, bool base64) {
  const TemporaryFolder folder;
  vtkNew<Reader> reader;
  reader->SetFileName(folder.file(name, text).c_str());
  reader->Update();
  vtkNew<Writer> writer;
  writer->SetInputData(reader->GetOutput());
  writer->SetFileName((folder / name).c_str());
  writer->SetCompressorType(compressor);
  writer->SetDataMode(mode);
  writer->SetEncodeAppendedData(base64);
  writer->SetHeaderType(vtkXMLWriter::UInt32);
  writer->SetBlockSize(64);
  writer->Write();
  return file_content(folder / name);
}

std::string written_vtp(int compressor, int mode, bool base64) {
  return rewritten<vtkXMLPolyDataReader, vtkXMLPolyDataWriter>("a.vtp", vtp, compressor, mode, base64);
}

std::string written_vtu(int compressor, int mode, bool base64) {
  return rewritten<vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter>("a.vtu", vtu, compressor, mode, base64);
}

TEST(DamagedFiles, OfBlocksAreNamed) {
  const auto words = [](std::initializer_list<std::uint32_t> numbers) {
    std::string bytes;
    for (const std::uint32_t number : numbers) bytes += bytes_of(number, false);
    return bytes;
  };
  // Points: 96 bytes, 64 and 32.
  expect_messages(
      "a.vtp", written_vtp(vtkXMLWriter::ZLIB, vtkXMLWriter::Appended, false),
      {{words({2, 64, 32}), words({2, 0, 32}), "its header states 2 blocks of 0 bytes, the last one of 32"},
       {words({2, 64, 32}), words({0, 64, 32}), "its header states 0 blocks of 64 bytes"},
       {words({2, 64, 32}), words({2, 64, 65}), "its header states 2 blocks of 64 bytes, the last one of 65"},
       {words({2, 64, 32}), words({4000000000, 64, 32}), "its header states 4000000000 blocks"},
       {words({2, 64, 32}), words({1, 64, 0}), "12 values are needed, it has 64 bytes"},
       {words({2, 64, 32}), words({2, 4000000000, 32}), "4000000000 uncompressed"},
       {"offset=\"0\"", "offset=\"99999\"", "offset=\"99999\": "},
       {"encoding=\"raw\"", "encoding=\"row\"", "encoding=\"row\": must be raw, base64"},
       {"vtkZLib", "vtkZlib", "compressor=\"vtkZlibDataCompressor\": must be vtkZLib"},
       {"</Piece>", "...", "</Piece>"},
       {words({2, 64, 32}), "...", "cut short"}});
  expect_messages(
      "a.vtp", written_vtp(vtkXMLWriter::NONE, vtkXMLWriter::Appended, false),
      {{words({96}), words({95}), "12 values are needed, it has 95 bytes"},
       {words({96}), words({4000000000}), "4000000000 bytes are stated"},
       {bytes_of(std::int64_t{6}, false), bytes_of(std::int64_t{1} << 62, false), "end at 4611686018427387904"}});
}

/// Throws whatever else than InputError the reader throws.
bool is_read(const std::filesystem::path& path) {
  try {
    read_mesh_file(path);
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find(path.string()), 0U) << error.what();
    return false;
  }
}

/// A new file each time: a file system may write at once what is written over.
std::filesystem::path new_file(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
  std::filesystem::remove(folder / name);
  return folder.file(name, content);
}

struct Sample {
  std::string name, content;
};

std::vector<Sample> samples() {
  return {{"a.ply", ply},
          {"b.ply", binary_ply(true)},
          {"a.vtk", surface_vtk},
          {"b.vtk", grid_vtk},
          {"c.vtk", binary_vtk()},
          {"a.vtp", vtp},
          {"a.vtu", vtu},
          {"b.vtp", written_vtp(vtkXMLWriter::NONE, vtkXMLWriter::Binary, false)},
          {"c.vtp", written_vtp(vtkXMLWriter::ZLIB, vtkXMLWriter::Appended, false)},
          {"b.vtu", written_vtu(vtkXMLWriter::LZ4, vtkXMLWriter::Appended, true)},
          {"c.vtu", written_vtu(vtkXMLWriter::NONE, vtkXMLWriter::Appended, false)}};
}

TEST(DamagedFiles, CutAnywhereAreReadOrRefused) {
  const std::vector<Sample> all = samples();
  const TemporaryFolder folder;
  const LessMemory memory(std::size_t{200} << 20);
  for (const Sample& sample : all)
    for (std::size_t length = 0; length < sample.content.size(); ++length) {
      const auto path = new_file(folder, sample.name, sample.content.substr(0, length));
      ASSERT_NO_THROW(is_read(path)) << sample.name << " cut at " << length;
    }
}

/// Numbers that a count, an offset or a node may have become.
std::string another_number(std::mt19937& random) {
  static const std::vector<std::string> numbers{
      "-1", "0",   "1",   "2", "255", "4294967296", "99999999999", "18446744073709551615", "4611686018427387904",
      "-3", "1e9", "nan", ""};
  return numbers[random() % numbers.size()];
}

void change_number(std::string& content, std::mt19937& random) {
  const std::size_t digit = content.find_first_of("0123456789", random() % content.size());
  if (digit == std::string::npos) return;
  const std::size_t end = std::min(content.find_first_not_of("0123456789", digit), content.size());
  content.replace(digit, end - digit, another_number(random));
}

void change(std::string& content, std::mt19937& random) {
  const std::size_t place = random() % content.size(), length = 1 + random() % 12;
  static const std::string likely = "0123456789-+. eE\n\0\xff<>\"/x=_";
  switch (random() % 6) {
    case 0:
      content[place] = static_cast<char>(random());
      break;
    case 1:
      content[place] = likely[random() % likely.size()];
      break;
    case 2:
      content.erase(place, length);
      break;
    case 3:
      content.insert(place, content.substr(random() % content.size(), length));
      break;
    case 4:
      content[place] = static_cast<char>(content[place] ^ (1 << random() % 8));
      break;
    default:
      change_number(content, random);
  }
}

TEST(DamagedFiles, ChangedAnywhereAreReadOrRefused) {
  const std::vector<Sample> all = samples();
  const TemporaryFolder folder;
  const LessMemory memory(std::size_t{200} << 20);
  std::mt19937 random(7);
  const char* asked = std::getenv("TETHER_MUTATIONS");  // more of them than a test has time for
  const int mutations = asked == nullptr ? 400 : std::atoi(asked);
  for (const Sample& sample : all) {
    int read = 0;
    for (int i = 0; i < mutations; ++i) {
      std::string content = sample.content;
      for (std::size_t changes = 1 + random() % 2; changes > 0 && !content.empty(); --changes) change(content, random);
      const auto path = new_file(folder, sample.name, content);
      ASSERT_NO_THROW(read += is_read(path)) << sample.name << " changed: " << i << "\n" << content;
    }
    EXPECT_GT(read, 0) << sample.name;
    EXPECT_LT(read, mutations) << sample.name;
    RecordProperty(sample.name + " read", read);
  }
}

}  // namespace damaged_files_test
}  // namespace tether
