#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "common/base/error.hpp"
#include "vessel/readers.hpp"

namespace tether {

namespace {

using Data = vtkSmartPointer<vtkPointSet>;

template <class Reader>
Data read_with(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  bool failed = false;  // many errors, as of a word among numbers, have no code
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&failed);
  note->SetCallback([](vtkObject*, unsigned long, void* data, void*) { *static_cast<bool*>(data) = true; });
  reader->AddObserver(vtkCommand::ErrorEvent, note);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (failed || reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr ||
      reader->GetOutput()->GetNumberOfPoints() == 0)
    throw input_error("{}: is not a readable VTK file of its kind, or has no points", path.string());
  return reader->GetOutput();
}

Data read_legacy(const std::filesystem::path& path) {
  vtkNew<vtkUnstructuredGridReader> probe;
  probe->SetFileName(path.c_str());
  if (probe->IsFileUnstructuredGrid()) return read_with<vtkUnstructuredGridReader>(path);
  if (probe->IsFilePolyData()) return read_with<vtkPolyDataReader>(path);
  throw input_error("{}: is not a VTK file with an unstructured grid or a surface", path.string());
}

Data read(const std::filesystem::path& path) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // errors are reported by exceptions
  vtkObject::GlobalWarningDisplayOn();                      // else no observer hears of them
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".vtu") return read_with<vtkXMLUnstructuredGridReader>(path);
  if (extension == ".vtp") return read_with<vtkXMLPolyDataReader>(path);
  if (extension == ".ply") return read_with<vtkPLYReader>(path);
  return read_legacy(path);
}

/// Sorts the cells by kind and remembers which cell each triangle came from.
class CellSorter {
 public:
  CellSorter(MeshFile& mesh, vtkPointSet& data) : mesh_(mesh), data_(data) {}

  std::vector<vtkIdType> sort() {
    vtkNew<vtkIdList> nodes;
    for (vtkIdType cell = 0; cell < data_.GetNumberOfCells(); ++cell) {
      data_.GetCellPoints(cell, nodes);
      check_nodes(cell, *nodes);
      add(cell, data_.GetCellType(cell), *nodes);
    }
    return std::move(triangle_cells_);
  }

 private:
  void check_nodes(vtkIdType cell, vtkIdList& list) const {
    for (vtkIdType i = 0; i < list.GetNumberOfIds(); ++i)
      if (const vtkIdType node = list.GetId(i); node < 0 || node >= data_.GetNumberOfPoints())
        throw input_error("{}: cell {} (from 0) names point {}: the file has {}, numbered from 0", mesh_.name, cell,
                          node, data_.GetNumberOfPoints());
  }
  void add(vtkIdType cell, int type, vtkIdList& list) {
    const auto node = [&](vtkIdType i) { return static_cast<int>(list.GetId(i)); };
    if (type == VTK_TETRA) {
      mesh_.tetrahedra.push_back({node(0), node(1), node(2), node(3)});
    } else if (type == VTK_WEDGE) {
      mesh_.prisms.push_back({node(0), node(2), node(1), node(3), node(5), node(4)});
    } else if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON) {
      for (vtkIdType i = 2; i < list.GetNumberOfIds(); ++i) {
        mesh_.triangles.push_back({node(0), node(i - 1), node(i)});
        triangle_cells_.push_back(cell);
      }
    } else if (type != VTK_VERTEX && type != VTK_LINE && type != VTK_POLY_VERTEX && type != VTK_POLY_LINE) {
      throw input_error("{}: cell {} is of VTK type {}: only linear tetrahedra, wedges and surface cells can be read",
                        mesh_.name, cell, type);
    }
  }

  MeshFile& mesh_;
  vtkPointSet& data_;
  std::vector<vtkIdType> triangle_cells_;
};

void read_labels(MeshFile& mesh, vtkCellData& arrays, const std::vector<vtkIdType>& triangle_cells) {
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = arrays.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr || array->GetNumberOfComponents() != 1) continue;
    std::vector<std::int64_t>& labels = mesh.triangle_labels[array->GetName()];
    for (const vtkIdType cell : triangle_cells)
      labels.push_back(static_cast<std::int64_t>(array->GetComponent(cell, 0)));
  }
}

}  // namespace

MeshFile read_vtk(const std::filesystem::path& path) {
  const Data data = read(path);
  MeshFile mesh;
  mesh.name = path.string();
  mesh.points.resize(3, data->GetNumberOfPoints());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) data->GetPoint(i, mesh.points.col(i).data());
  const std::vector<vtkIdType> triangle_cells = CellSorter(mesh, *data).sort();
  read_labels(mesh, *data->GetCellData(), triangle_cells);
  if (vtkDataArray* ids = data->GetPointData()->GetArray("GlobalNodeID"))
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
      mesh.node_ids.push_back(static_cast<std::int64_t>(ids->GetComponent(i, 0)));
  return mesh;
}

}  // namespace tether
