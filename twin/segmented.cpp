#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkImageGaussianSmooth.h>
#include <vtkImageThreshold.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>

#include "common/mesh/surface.hpp"
#include "twin/voxels.hpp"

namespace tether {
namespace {

using Image = vtkSmartPointer<vtkImageData>;

Image image_of(const VoxelImage& from) {
  auto image = Image::New();
  image->SetDimensions(from.count.data());
  image->SetOrigin(from.origin.data());
  image->SetSpacing(from.spacing.data());
  image->AllocateScalars(VTK_FLOAT, 1);
  std::copy(from.values.begin(), from.values.end(), static_cast<float*>(image->GetScalarPointer()));
  return image;
}

Image blurred(const Image& image, double deviation) {
  if (deviation <= 0) return image;
  vtkNew<vtkImageGaussianSmooth> filter;
  filter->SetInputData(image);
  filter->SetNumberOfThreads(1);
  filter->SetStandardDeviations(deviation / image->GetSpacing()[0], deviation / image->GetSpacing()[1],
                                deviation / image->GetSpacing()[2]);
  filter->SetRadiusFactors(4, 4, 4);
  filter->Update();
  return filter->GetOutput();
}

Image marked(const Image& image) {
  vtkNew<vtkImageThreshold> filter;
  filter->SetInputData(image);
  filter->ThresholdByUpper(0.5);
  filter->SetInValue(1);
  filter->SetOutValue(0);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> level(const Image& image) {
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 0.5);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  return filter->GetOutput();
}

/// A pass band of 0.1 keeps shapes above some ten voxels (Taubin, Zhang and Golub 1996).
vtkSmartPointer<vtkPolyData> smoothed(vtkPolyData* surface, int passes) {
  if (passes == 0 || surface->GetNumberOfPolys() == 0) return surface;
  vtkNew<vtkWindowedSincPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetNumberOfIterations(passes);
  filter->SetPassBand(0.1);
  filter->NormalizeCoordinatesOn();
  filter->FeatureEdgeSmoothingOff();
  filter->NonManifoldSmoothingOn();
  filter->Update();
  return filter->GetOutput();
}

TriangleSurface surface_of(vtkPolyData& from) {
  TriangleSurface surface{Points(3, from.GetNumberOfPoints()), {}};
  for (vtkIdType i = 0; i < from.GetNumberOfPoints(); ++i) from.GetPoint(i, surface.points.col(i).data());
  const vtkIdType* nodes = nullptr;
  vtkIdType count = 0;
  for (auto cells = vtk::TakeSmartPointer(from.GetPolys()->NewIterator()); !cells->IsDoneWithTraversal();
       cells->GoToNextCell()) {
    cells->GetCurrentCell(count, nodes);
    surface.triangles.push_back({static_cast<int>(nodes[0]), static_cast<int>(nodes[1]), static_cast<int>(nodes[2])});
  }
  return surface;
}

/// With its normals outward: six times the volume within is positive.
void turn_outward(TriangleSurface& surface) {
  double volume = 0;
  for (const Triangle& t : surface.triangles) volume += area_vector(surface.points, t).dot(surface.points.col(t[0]));
  if (volume >= 0) return;
  for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
}

}  // namespace

TriangleSurface segmented(const VoxelImage& image, const Segmentation& how) {
  Image grey = blurred(image_of(image), how.blur);
  const auto surface = smoothed(level(how.mask ? marked(grey) : grey), how.smoothing);
  TriangleSurface result = surface_of(*surface);
  turn_outward(result);
  return result;
}

}  // namespace tether
