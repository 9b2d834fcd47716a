#include "pictures/scene.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkClipDataSet.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVariant.h>
#include <vtkWarpVector.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Eigenvalues>

#include "common/base/error.hpp"
#include "common/base/types.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

using DataSet = vtkSmartPointer<vtkPointSet>;

template <class Reader>
DataSet read_with(const std::filesystem::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

DataSet read(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw input_error("{}: no such file", path.string());
  return path.extension() == ".vtp" ? read_with<vtkXMLPolyDataReader>(path)
                                    : read_with<vtkXMLUnstructuredGridReader>(path);
}

/// Adds what is shown as the active scalars: the field's values or magnitudes, times the scene's factor.
void add_shown(vtkPointSet* mesh, const Scene& scene) {
  vtkDataSetAttributes* data = mesh->GetPointData();
  if (!data->HasArray(scene.field.c_str())) data = mesh->GetCellData();
  vtkDataArray* field = data->GetArray(scene.field.c_str());
  if (field == nullptr) throw input_error("{}: has no field '{}'", scene.mesh.string(), scene.field);
  vtkNew<vtkDoubleArray> shown;
  shown->SetName("shown");
  const int components = field->GetNumberOfComponents();
  for (vtkIdType i = 0; i < field->GetNumberOfTuples(); ++i) {
    double square = 0;
    for (int c = 0; c < components; ++c) square += std::pow(field->GetComponent(i, c), 2);
    shown->InsertNextValue(scene.factor * (components == 1 ? field->GetComponent(i, 0) : std::sqrt(square)));
  }
  data->AddArray(shown);
  data->SetActiveScalars("shown");
}

DataSet displaced(const DataSet& mesh, const Scene& scene) {
  if (scene.warp.empty()) return mesh;
  if (!mesh->GetPointData()->HasArray(scene.warp.c_str()))
    throw input_error("{}: has no field '{}'", scene.mesh.string(), scene.warp);
  mesh->GetPointData()->SetActiveVectors(scene.warp.c_str());
  vtkNew<vtkWarpVector> warp;
  warp->SetInputData(mesh);
  warp->SetScaleFactor(scene.warp_scale);
  warp->Update();
  return warp->GetOutput();
}

/// Where the vessel lies: its centre, and its directions from the longest to the shortest.
struct Place {
  Vec3 centre;
  Mat3 directions;
  double length;
};

Place place_of(vtkPointSet* mesh) {
  const vtkIdType count = mesh->GetNumberOfPoints();
  Points x(3, count);
  for (vtkIdType i = 0; i < count; ++i) mesh->GetPoint(i, x.col(i).data());
  Place place;
  place.centre = x.rowwise().mean();
  const Points from_centre = x.colwise() - place.centre;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(from_centre * from_centre.transpose() / static_cast<double>(count));
  place.directions = axes.eigenvectors().rowwise().reverse();
  if (place.directions.col(0).sum() < 0) place.directions.col(0) *= -1;  // the same way up whatever the signs
  if (place.directions.col(1).sum() < 0) place.directions.col(1) *= -1;
  place.directions.col(2) = place.directions.col(0).cross(place.directions.col(1));
  place.length = 2 * from_centre.colwise().norm().maxCoeff();
  return place;
}

/// A colour for each of the names, which neighbours do not share: hues a golden section apart, light and dark in turn.
vtkSmartPointer<vtkColorTransferFunction> colours_of_names(std::size_t count) {
  constexpr double golden = 0.618034, half = 0.499;
  const auto table = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<double>(i);
    const double hue = std::fmod(0.6 + golden * at, 1), value = i % 2 == 0 ? 0.95 : 0.65;
    double rgb[3];
    vtkMath::HSVToRGB(hue, 0.65, value, &rgb[0], &rgb[1], &rgb[2]);
    table->AddRGBPoint(at - half, rgb[0], rgb[1], rgb[2]);
    table->AddRGBPoint(at + half, rgb[0], rgb[1], rgb[2]);
  }
  return table;
}

vtkSmartPointer<vtkColorTransferFunction> colours(const Scene& scene, vtkPointSet* mesh) {
  double range[2];
  vtkDataArray* shown = mesh->GetPointData()->GetArray("shown");
  (shown != nullptr ? shown : mesh->GetCellData()->GetArray("shown"))->GetRange(range);
  if (scene.range) range[0] = scene.range->first, range[1] = scene.range->second;
  if (!scene.range && scene.diverging)
    range[1] = std::max(std::abs(range[0]), std::abs(range[1])), range[0] = -range[1];
  const auto at = [&range](double s) { return range[0] + s * (range[1] - range[0]); };
  const auto table = vtkSmartPointer<vtkColorTransferFunction>::New();
  table->SetNanColor(0.82, 0.82, 0.82);
  if (scene.diverging) {  // Moreland's cool to warm
    table->SetColorSpaceToDiverging();
    table->AddRGBPoint(at(0), 0.23, 0.30, 0.75);
    table->AddRGBPoint(at(1), 0.71, 0.02, 0.15);
  } else {  // viridis at five places
    constexpr double rgb[5][3] = {
        {0.27, 0.00, 0.33}, {0.23, 0.32, 0.55}, {0.13, 0.57, 0.55}, {0.37, 0.79, 0.38}, {0.99, 0.91, 0.14}};
    for (int i = 0; i < 5; ++i) table->AddRGBPoint(at(i / 4.0), rgb[i][0], rgb[i][1], rgb[i][2]);
  }
  return table;
}

DataSet half_behind(const DataSet& mesh, const Place& place, const Vec3& toward_viewer) {
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(place.centre.data());
  plane->SetNormal(Vec3(-toward_viewer).eval().data());
  vtkNew<vtkClipDataSet> clip;
  clip->SetInputData(mesh);
  clip->SetClipFunction(plane);
  clip->Update();
  return clip->GetOutput();
}

void add_surface(vtkRenderer* renderer, const DataSet& mesh, vtkColorTransferFunction* table) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(mesh);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->SetLookupTable(table);
  mapper->SetUseLookupTableScalarRange(true);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.65);
  renderer->AddActor(actor);
}

/// Brought forward, which parallel projection does not show: lines just inside the mesh are seen too, those behind it
/// are not.
void add_lines(vtkRenderer* renderer, const std::filesystem::path& path, const Vec3& forward) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(vtkPolyData::SafeDownCast(read(path)));
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0, 0, 0);
  actor->GetProperty()->SetLineWidth(2.5F);
  actor->SetPosition(forward.x(), forward.y(), forward.z());
  renderer->AddActor(actor);
}

void add_scale(vtkRenderer* renderer, vtkColorTransferFunction* table, const Scene& scene) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(table);
  bar->SetTitle(scene.title.c_str());
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.3g");
  bar->SetUnconstrainedFontSize(true);
  bar->SetVerticalTitleSeparation(scene.width / 75);  // the topmost number stands as high as the bar's end
  for (vtkTextProperty* text :
       {bar->GetTitleTextProperty(), bar->GetLabelTextProperty(), bar->GetAnnotationTextProperty()}) {
    text->SetColor(0, 0, 0);
    text->SetFontSize(scene.width / 75);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
  }
  if (!scene.names.empty()) {
    for (std::size_t i = 0; i < scene.names.size(); ++i)
      table->SetAnnotation(vtkVariant(static_cast<double>(i)), scene.names[i]);
    bar->DrawAnnotationsOn();
    bar->DrawTickLabelsOff();
    bar->SetTextPositionToPrecedeScalarBar();  // annotations stand on the other side
  }
  bar->SetPosition(0.05, 0.15);
  bar->SetWidth(scene.names.empty() ? 0.9 : 0.35);  // names stand beside it
  bar->SetHeight(0.7);
  renderer->AddActor2D(bar);
}

/// The long direction points up; parallel projection, so that two sides compare.
void aim(vtkRenderer* renderer, const Place& place, const Vec3& toward_viewer) {
  vtkCamera* camera = renderer->GetActiveCamera();
  const Vec3 position = place.centre + 2 * place.length * toward_viewer, up = place.directions.col(0);
  camera->SetFocalPoint(place.centre.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(up.data());
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.53 * place.length);
  renderer->ResetCameraClippingRange();
}

void write(vtkRenderWindow* window, const std::filesystem::path& png) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(png.c_str());
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  if (writer->GetErrorCode() != 0 || !std::filesystem::exists(png)) throw write_error(png);
}

}  // namespace

void draw(const Scene& scene, const std::filesystem::path& png) {
  DataSet mesh = read(scene.mesh);
  add_shown(mesh, scene);
  mesh = displaced(mesh, scene);
  const Place place = place_of(mesh);
  const auto table = scene.names.empty() ? colours(scene, mesh) : colours_of_names(scene.names.size());
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(scene.width, scene.height);
  constexpr double edges[4] = {0, 0.42, 0.84, 1};
  for (int view = 0; view < 3; ++view) {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1, 1, 1);
    renderer->SetViewport(edges[view], 0, edges[view + 1], 1);
    window->AddRenderer(renderer);
    if (view == 2) {
      add_scale(renderer, table, scene);
      continue;
    }
    const Vec3 toward_viewer = place.directions.col(2 - view);
    add_surface(renderer, scene.cut ? half_behind(mesh, place, toward_viewer) : mesh, table);
    if (!scene.lines.empty()) add_lines(renderer, scene.lines, 0.03 * place.length * toward_viewer);
    aim(renderer, place, toward_viewer);
  }
  window->Render();
  write(window, png);
}

}  // namespace tether
