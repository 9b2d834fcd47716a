#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/lower_case.hpp"
#include "vessel/cell_sorter.hpp"
#include "vessel/readers.hpp"
#include "vessel/xml_check.hpp"

/// .vtp and .vtu, by VTK.
namespace tether {

namespace {

/// VTK's own words, without its source file and object: "ERROR: In a.cxx, line 7\nvtkX (0x5): words\n\n".
void note_error(vtkObject*, unsigned long, void* noted, void* said) {
  auto& words = *static_cast<std::string*>(noted);
  if (!words.empty()) return;  // the first one is the cause
  words = said == nullptr ? "is damaged" : static_cast<const char*>(said);
  if (const std::size_t object = words.find("): "); object != std::string::npos) words.erase(0, object + 3);
  words.erase(words.find_last_not_of(" \n") + 1);
}

template <class Reader>
auto read_with(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  std::string error;  // many errors, as of a word among numbers, have no code
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&error);
  note->SetCallback(note_error);
  reader->AddObserver(vtkCommand::ErrorEvent, note);
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::exception& exception) {  // std::bad_alloc, std::length_error
    throw input_error("{}: states more than can be read ({})", path.string(), exception.what());
  }
  if (!error.empty() || reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr)
    throw input_error("{}: is not a readable VTK file of its kind: {}", path.string(), error);
  if (reader->GetOutput()->GetNumberOfPoints() == 0) throw input_error("{}: has no points", path.string());
  return vtkSmartPointer(reader->GetOutput());
}

std::vector<std::int64_t> integers(vtkDataArray& array) {
  std::vector<std::int64_t> values;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i)
    values.push_back(static_cast<std::int64_t>(array.GetComponent(i, 0)));
  return values;
}

std::vector<double> reals(vtkDataArray& array) {
  std::vector<double> values;
  for (vtkIdType i = 0; i < array.GetNumberOfTuples(); ++i) values.push_back(array.GetComponent(i, 0));
  return values;
}

/// Adds the cells of one list, whose types are type(cell), and which are numbered on from those before.
void add_cells(const MeshFile& mesh, vtkCellArray& cells, const std::function<int(std::size_t)>& type,
               CellSorter& sorter) {
  const std::vector<std::int64_t> nodes = integers(*cells.GetConnectivityArray()),
                                  ends = integers(*cells.GetOffsetsArray());
  for (std::size_t cell = 0; cell + 1 < ends.size(); ++cell) {
    if (ends[cell] < 0 || ends[cell + 1] < ends[cell] || ends[cell + 1] > static_cast<std::int64_t>(nodes.size()))
      throw input_error("{}: the nodes of cell {} (from 0) are numbers {} to {} of {}", mesh.name, sorter.cells(),
                        ends[cell], ends[cell + 1], nodes.size());
    const auto its = std::span(nodes).subspan(static_cast<std::size_t>(ends[cell]),
                                              static_cast<std::size_t>(ends[cell + 1] - ends[cell]));
    if (const std::string wrong = wrong_node(sorter.cells(), its, mesh.points.cols()); !wrong.empty())
      throw input_error("{}: {}", mesh.name, wrong);
    sorter.add(type(cell), its);
  }
}

void add_surface_cells(const MeshFile& mesh, vtkPolyData& data, CellSorter& sorter) {
  const std::array<std::pair<vtkCellArray*, int>, 4> lists{{{data.GetVerts(), vtk_poly_vertex},
                                                            {data.GetLines(), vtk_poly_line},
                                                            {data.GetPolys(), vtk_polygon},
                                                            {data.GetStrips(), vtk_triangle_strip}}};
  for (const auto& [cells, type] : lists)
    if (cells != nullptr)
      add_cells(
          mesh, *cells, [type = type](std::size_t) { return type; }, sorter);
}

void add_grid_cells(const MeshFile& mesh, vtkUnstructuredGrid& data, CellSorter& sorter) {
  vtkUnsignedCharArray* types = data.GetCellTypesArray();
  if (data.GetCells() == nullptr || types == nullptr) throw input_error("{}: has no cells", mesh.name);
  if (types->GetNumberOfTuples() != data.GetCells()->GetNumberOfCells())
    throw input_error("{}: {} cells have {} types", mesh.name, data.GetCells()->GetNumberOfCells(),
                      types->GetNumberOfTuples());
  const auto type = [&](std::size_t cell) { return int{types->GetValue(static_cast<vtkIdType>(cell))}; };
  add_cells(mesh, *data.GetCells(), type, sorter);
}

MeshFile mesh_of(const std::filesystem::path& path, vtkPointSet& data,
                 const std::function<void(const MeshFile&, CellSorter&)>& add) {
  MeshFile mesh;
  mesh.name = path.string();
  mesh.points.resize(3, data.GetNumberOfPoints());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) data.GetPoint(i, mesh.points.col(i).data());
  CellSorter sorter(mesh);
  add(mesh, sorter);
  vtkCellData& arrays = *data.GetCellData();
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
    if (vtkDataArray* array = arrays.GetArray(i);
        array != nullptr && array->GetName() != nullptr && array->GetNumberOfComponents() == 1)
      add_labels(mesh, array->GetName(), reals(*array), sorter);
  if (vtkDataArray* ids = data.GetPointData()->GetArray("GlobalNodeID")) add_node_ids(mesh, reals(*ids));
  return mesh;
}

}  // namespace

MeshFile read_xml_vtk(const std::filesystem::path& path) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // errors are reported by exceptions
  vtkObject::GlobalWarningDisplayOn();                      // else no observer hears of them
  if (lower_case(path.extension().string()) == ".vtp") {
    check_xml_vtk(path, "PolyData");
    const auto data = read_with<vtkXMLPolyDataReader>(path);
    return mesh_of(path, *data,
                   [&](const MeshFile& mesh, CellSorter& sorter) { add_surface_cells(mesh, *data, sorter); });
  }
  check_xml_vtk(path, "UnstructuredGrid");
  const auto data = read_with<vtkXMLUnstructuredGridReader>(path);
  return mesh_of(path, *data, [&](const MeshFile& mesh, CellSorter& sorter) { add_grid_cells(mesh, *data, sorter); });
}

}  // namespace tether
