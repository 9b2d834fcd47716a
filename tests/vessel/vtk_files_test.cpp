#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <initializer_list>
#include <vector>

#include "tests/io/temporary_folder.hpp"
#include "vessel/readers.hpp"

/// What our readers make of the files that VTK writes, against what VTK's own readers make of them.
namespace tether {
namespace vtk_files_test {

void add_points(vtkPointSet& data) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 12; ++i) points->InsertNextPoint(0.1 * i, i % 3 / 3.0, (i % 5) * 1e-3);
  data.SetPoints(points);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalNodeID");
  for (int i = 0; i < 12; ++i) ids->InsertNextValue(100 + 7 * i);
  data.GetPointData()->AddArray(ids);
  vtkNew<vtkDoubleArray> velocity;
  velocity->SetName("velocity");
  velocity->SetNumberOfComponents(3);
  for (int i = 0; i < 12; ++i) velocity->InsertNextTuple3(i, 0.5, -i);
  data.GetPointData()->SetVectors(velocity);
  data.GetPointData()->SetNormals(velocity);
}

/// Of each kind that a file can hold.
void add_arrays(vtkDataSet& data) {
  vtkNew<vtkIntArray> face;
  vtkNew<vtkDoubleArray> part, stress;
  vtkNew<vtkUnsignedCharArray> flag;
  vtkNew<vtkStringArray> text;
  face->SetName("ModelFaceID");
  part->SetName("a part of 50 %");
  stress->SetName("stress");
  stress->SetNumberOfComponents(9);
  flag->SetName("flag");
  text->SetName("text");
  for (int cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    face->InsertNextValue(cell * cell - 3);
    part->InsertNextValue(1.5 * cell);
    stress->InsertNextTuple9(1, 2, 3, 4, 5, 6, 7, 8, cell);
    flag->InsertNextValue(static_cast<unsigned char>(cell));
    text->InsertNextValue(std::string(static_cast<std::size_t>(60 * cell), 'x'));
  }
  data.GetCellData()->SetScalars(face);
  data.GetCellData()->SetTensors(stress);
  for (vtkAbstractArray* array : std::initializer_list<vtkAbstractArray*>{part, flag, text})
    data.GetCellData()->AddArray(array);
  vtkNew<vtkDoubleArray> time;
  time->SetName("TIME");
  time->InsertNextValue(0.25);
  data.GetFieldData()->AddArray(time);
}

vtkNew<vtkCellArray> cells(const std::vector<std::vector<vtkIdType>>& nodes) {
  vtkNew<vtkCellArray> cells;
  for (const auto& cell : nodes) cells->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  return cells;
}

vtkSmartPointer<vtkPolyData> surface() {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  add_points(*data);
  data->SetVerts(cells({{0}, {1, 2}}));
  data->SetLines(cells({{3, 4}, {4, 5, 6}}));
  data->SetPolys(cells({{0, 1, 2}, {2, 3, 4, 5}, {5, 6, 7, 8, 9}}));
  data->SetStrips(cells({{7, 8, 9, 10, 11}}));
  add_arrays(*data);
  return data;
}

vtkSmartPointer<vtkUnstructuredGrid> grid() {
  auto data = vtkSmartPointer<vtkUnstructuredGrid>::New();
  add_points(*data);
  const auto add = [&](int type, const std::vector<vtkIdType>& nodes) {
    data->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
  };
  add(VTK_TETRA, {0, 1, 2, 4});
  add(VTK_TRIANGLE, {4, 5, 6});
  add(VTK_WEDGE, {6, 7, 8, 9, 10, 11});
  add(VTK_QUAD, {0, 3, 6, 9});
  add(VTK_LINE, {1, 2});
  add(VTK_VERTEX, {5});
  add(VTK_POLYGON, {1, 3, 5, 7, 9});
  add_arrays(*data);
  return data;
}

/// The mesh of what VTK read.
MeshFile by_vtk(vtkPointSet& data) {
  MeshFile mesh;
  mesh.points.resize(3, data.GetNumberOfPoints());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) data.GetPoint(i, mesh.points.col(i).data());
  std::vector<vtkIdType> triangle_cells;
  const auto add = [&](vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c) {
    mesh.triangles.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
    triangle_cells.push_back(cell);
  };
  for (vtkIdType cell = 0; cell < data.GetNumberOfCells(); ++cell) {
    vtkNew<vtkIdList> list;
    data.GetCellPoints(cell, list);
    const auto n = [&](int i) { return static_cast<int>(list->GetId(i)); };
    const int type = data.GetCellType(cell);
    if (type == VTK_TETRA) mesh.tetrahedra.push_back({n(0), n(1), n(2), n(3)});
    if (type == VTK_WEDGE) mesh.prisms.push_back({n(0), n(2), n(1), n(3), n(5), n(4)});
    for (int i = 2; i < list->GetNumberOfIds(); ++i) {
      if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON) add(cell, n(0), n(i - 1), n(i));
      if (type == VTK_TRIANGLE_STRIP && i % 2 == 0) add(cell, n(i - 2), n(i - 1), n(i));
      if (type == VTK_TRIANGLE_STRIP && i % 2 == 1) add(cell, n(i - 1), n(i - 2), n(i));
    }
  }
  for (int i = 0; i < data.GetCellData()->GetNumberOfArrays(); ++i)
    if (vtkDataArray* array = data.GetCellData()->GetArray(i); array && array->GetNumberOfComponents() == 1)
      for (const vtkIdType cell : triangle_cells)
        mesh.triangle_labels[array->GetName()].push_back(static_cast<std::int64_t>(array->GetComponent(cell, 0)));
  if (vtkDataArray* ids = data.GetPointData()->GetArray("GlobalNodeID"))
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
      mesh.node_ids.push_back(static_cast<std::int64_t>(ids->GetComponent(i, 0)));
  return mesh;
}

void expect_same(const MeshFile& ours, const MeshFile& theirs) {
  EXPECT_EQ(ours.points, theirs.points);
  EXPECT_EQ(ours.triangles, theirs.triangles);
  EXPECT_EQ(ours.tetrahedra, theirs.tetrahedra);
  EXPECT_EQ(ours.prisms, theirs.prisms);
  EXPECT_EQ(ours.triangle_labels, theirs.triangle_labels);
  EXPECT_EQ(ours.node_ids, theirs.node_ids);
}

template <class Reader>
MeshFile read_by_vtk(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return by_vtk(*reader->GetOutput());
}

template <class Writer, class Reader>
void compare_legacy(vtkDataSet& data) {
  const TemporaryFolder folder;
  const auto path = folder / "mesh.vtk";
  for (const int version : {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1})
    for (const int encoding : {VTK_ASCII, VTK_BINARY}) {
      SCOPED_TRACE(fmt::format("version {}, {}", version, encoding == VTK_ASCII ? "text" : "binary"));
      vtkNew<Writer> writer;
      writer->SetInputData(&data);
      writer->SetFileName(path.c_str());
      writer->SetFileType(encoding);
      writer->SetFileVersion(version);
      writer->Write();
      const MeshFile ours = read_legacy_vtk(path);
      expect_same(ours, read_by_vtk<Reader>(path));
      EXPECT_EQ(ours.triangle_labels.size(), 3U);
      EXPECT_EQ(ours.node_ids.size(), 12U);
    }
}

TEST(LegacyVtk, SurfacesAreReadAsVtkReadsThem) {
  compare_legacy<vtkPolyDataWriter, vtkPolyDataReader>(*surface());
}

TEST(LegacyVtk, GridsAreReadAsVtkReadsThem) {
  compare_legacy<vtkUnstructuredGridWriter, vtkUnstructuredGridReader>(*grid());
}

TEST(LegacyVtk, AllAttributesAreReadAsVtkReadsThem) {
  const TemporaryFolder folder;
  const auto path = folder.file(
      "attributes.vtk",
      "# vtk DataFile Version 2.0\n\nascii\nfield FieldData 1\nTIME 1 1 double\n0.5\ndataset polydata\npoints 4 float\n"
      "0 0 0 1 0 0 0 1 0 0 0 1\npolygons 2 7\n3 0 1 2 2 0 3\n");
  EXPECT_NE(message_of([&] { read_legacy_vtk(path); }).find("attributes.vtk:11: cell 1 (from 0) has 2 nodes"),
            std::string::npos);
  folder.file("attributes.vtk",
              "# vtk DataFile Version 2.0\n\nascii\ndataset polydata\npoints 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n"
              "polygons 2 8\n3 0 1 2 3 0 3 2\ncell_data 2\nscalars kind short 1\nlookup_table colours\n-4 5\n"
              "LOOKUP_TABLE colours 2\n0 0 0 1 1 1 1 1\nvectors v float\n1 2 3 4 5 6\n"
              "texture_coordinates u 1 float\n7.5 -8.5\ntensors t float\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n"
              "GLOBAL_IDS id vtkIdType\n70 71\nfield more 2\nbits 1 2 bit\n1 0\nempty 2 0 int\n\npoint_data 4\n"
              "pedigree_ids GlobalNodeID vtkIdType\n4 5 6 7\n");
  expect_same(read_legacy_vtk(path), read_by_vtk<vtkPolyDataReader>(path));
  EXPECT_EQ(read_legacy_vtk(path).triangle_labels.size(), 4U);
}

TEST(LegacyVtk, ColoursAndLaterScalarsAreReadToo) {
  const TemporaryFolder folder;
  const std::string grey =
      "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 2 8\n"
      "3 0 1 2 3 0 2 1\nCELL_DATA 2\nCOLOR_SCALARS grey 1\n0.25 1\n";
  const auto path = folder.file("grey.vtk", grey);
  expect_same(read_legacy_vtk(path), read_by_vtk<vtkPolyDataReader>(path));
  folder.file("grey.vtk", grey + "SCALARS kind int\nLOOKUP_TABLE default\n3 4\n");
  EXPECT_EQ(read_legacy_vtk(path).triangle_labels.at("kind"),
            (std::vector<std::int64_t>{3, 4}));  // VTK: only the first
}

TEST(Ply, FilesOfVtkAreReadAsVtkReadsThem) {
  const TemporaryFolder folder;
  const auto path = folder / "surface.ply";
  const auto data = surface();
  data->SetStrips(nullptr);
  for (const auto& [type, order] :
       {std::pair{VTK_ASCII, VTK_LITTLE_ENDIAN}, {VTK_BINARY, VTK_LITTLE_ENDIAN}, {VTK_BINARY, VTK_BIG_ENDIAN}}) {
    vtkNew<vtkPLYWriter> writer;
    writer->SetInputData(data);
    writer->SetFileName(path.c_str());
    writer->SetFileType(type);
    writer->SetDataByteOrder(order);
    writer->Write();
    const MeshFile ours = read_ply(path);
    expect_same(ours, read_by_vtk<vtkPLYReader>(path));
    EXPECT_EQ(ours.triangles.size(), 6U);
  }
}

TEST(Ply, OtherPropertiesAndElementsArePassedOver) {
  const TemporaryFolder folder;
  const MeshFile mesh = read_ply(folder.file(
      "other.ply",
      "ply\r\nformat ascii 1.0\r\ncomment x y\r\nobj_info 3\r\nelement material 1\r\nproperty list uchar int parts\r\n"
      "property uchar red\r\nelement vertex 3\r\nproperty uchar flag\r\nproperty double z\r\nproperty double y\r\n"
      "property double x\r\nproperty list int float weights\r\nelement face 1\r\nproperty short kind\r\n"
      "property list uint8 uint32 vertex_index\r\nproperty list uchar float texcoord\r\nelement edge 1\r\n"
      "property int a\r\nend_header\r\n2 5 6 255\r\n\r\n1 3 2 1 0\r\n1 +6 5 4e0 2 0.5 0.5\r\n1 9 8 7 1 .5\r\n"
      "4 3 0 1 2 0\r\n7"));
  EXPECT_EQ(mesh.points.col(1), Vec3(4, 5, 6));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

template <class Writer>
void compare_xml(vtkPointSet& data, const std::string& extension) {
  const TemporaryFolder folder;
  const auto path = folder / ("mesh" + extension);
  const MeshFile theirs = by_vtk(data);
  for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA})
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
      for (const bool other : {false, true}) {
        SCOPED_TRACE(fmt::format("compressor {}, mode {}, {}", compressor, mode, other));
        vtkNew<Writer> writer;
        writer->SetInputData(&data);
        writer->SetFileName(path.c_str());
        writer->SetCompressorType(compressor);
        writer->SetDataMode(mode);
        writer->SetHeaderType(other ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
        writer->SetByteOrder(other ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
        writer->SetEncodeAppendedData(other);
        writer->SetBlockSize(64);
        writer->Write();
        expect_same(read_xml_vtk(path), theirs);
      }
}

TEST(XmlVtk, SurfacesOfAllFlavoursAreRead) {
  compare_xml<vtkXMLPolyDataWriter>(*surface(), ".vtp");
}

TEST(XmlVtk, GridsOfAllFlavoursAreRead) {
  compare_xml<vtkXMLUnstructuredGridWriter>(*grid(), ".vtu");
}

}  // namespace vtk_files_test
}  // namespace tether
