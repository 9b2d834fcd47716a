#include "vessel/image/zero_surface.hpp"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <Eigen/LU>

namespace tether {

RawSurface zero_surface(const ImageVolume& field) {
  vtkNew<vtkFloatArray> values;  // looks at the field's own values
  values->SetArray(const_cast<float*>(field.values.data()), static_cast<vtkIdType>(field.values.size()), 1);
  vtkNew<vtkImageData> image;
  image->SetDimensions(field.count.data());
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> filter;
  filter->SetInputData(image);
  filter->SetValue(0, 0);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  vtkPolyData& found = *filter->GetOutput();
  RawSurface surface{Points(3, found.GetNumberOfPoints()), {}, {}};
  for (vtkIdType i = 0; i < found.GetNumberOfPoints(); ++i)
    surface.points.col(i) = field.place(Vec3(found.GetPoint(i)));
  const bool turned = field.axes.determinant() < 0;
  const vtkIdType* nodes = nullptr;
  vtkIdType count = 0;
  for (auto cells = vtk::TakeSmartPointer(found.GetPolys()->NewIterator()); !cells->IsDoneWithTraversal();
       cells->GoToNextCell()) {
    cells->GetCurrentCell(count, nodes);
    Triangle t{static_cast<int>(nodes[0]), static_cast<int>(nodes[1]), static_cast<int>(nodes[2])};
    if (turned) std::swap(t[1], t[2]);
    surface.triangles.push_back(t);
  }
  surface.face_id.assign(surface.triangles.size(), 0);
  return surface;
}

}  // namespace tether
