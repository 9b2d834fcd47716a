#include "vessel/image/slices.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

constexpr int panel = 420, gap = 6;  // pixels

/// Red, green, blue; the first row is the lowest, as VTK has it.
class Canvas {
 public:
  Canvas(int width, int height) {
    image_->SetDimensions(width, height, 1);
    image_->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    std::fill_n(static_cast<unsigned char*>(image_->GetScalarPointer()), 3 * width * height, 255);
  }
  void set(int x, int y, unsigned char red, unsigned char green, unsigned char blue) {
    const int* size = image_->GetDimensions();
    if (x < 0 || y < 0 || x >= size[0] || y >= size[1]) return;
    auto* pixel = static_cast<unsigned char*>(image_->GetScalarPointer(x, y, 0));
    pixel[0] = red, pixel[1] = green, pixel[2] = blue;
  }
  void write(const std::filesystem::path& file) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(file.c_str());
    writer->SetInputData(image_);
    writer->Write();
    if (writer->GetErrorCode() != 0) throw write_error(file);
  }

 private:
  vtkNew<vtkImageData> image_;
};

/// What of the image is drawn: the surface's box with a margin, in indices; values from black to white.
struct View {
  Vec3 low, high;
  float black = 0, white = 1;
};

View view_of(const ImageVolume& image, const Points& index) {
  View view;
  const Vec3 last = Vec3(image.count[0], image.count[1], image.count[2]).array() - 1;
  const Vec3 size = index.rowwise().maxCoeff() - index.rowwise().minCoeff();
  const Vec3 margin = Vec3::Constant(0.2 * size.cwiseProduct(image.spacing).maxCoeff()).cwiseQuotient(image.spacing);
  view.low = (index.rowwise().minCoeff() - margin).cwiseMax(0),
  view.high = (index.rowwise().maxCoeff() + margin).cwiseMin(last);
  std::vector<float> values;
  for (std::size_t n = 0; n < image.values.size(); n += 1 + image.values.size() / 200000)
    values.push_back(image.values[n]);
  std::sort(values.begin(), values.end());
  view.black = values[values.size() / 200], view.white = values[values.size() - 1 - values.size() / 200];
  if (!(view.white > view.black)) view.black = values.front(), view.white = values.back() + 1;
  return view;
}

/// A slice at one index of `across`, drawn with the patient's left, back or head to the right, below or above.
class Slice {
 public:
  Slice(const ImageVolume& image, const View& view, int across, double at)
      : image_(image), view_(view), across_(across), right_(across == 0 ? 1 : 0), up_(across == 2 ? 1 : 2), at_(at) {
    const Vec3 size = (view.high - view.low).cwiseProduct(image.spacing);
    pixel_ = std::max(size[right_], size[up_]) / panel;
    mirrored_ = main_sign(right_) < 0;
    const int upward = main_axis(up_) == 2 ? 1 : -1;  // the head above; the back below
    upside_down_ = upward * main_sign(up_) < 0;
  }

  void draw(Canvas& canvas, int x0, int y0) const {
    const Vec3 size = (view_.high - view_.low).cwiseProduct(image_.spacing);
    for (int y = 0; y < std::min<int>(panel, static_cast<int>(size[up_] / pixel_)); ++y)
      for (int x = 0; x < std::min<int>(panel, static_cast<int>(size[right_] / pixel_)); ++x) {
        const double share =
            (image_.values[image_.nearest(image_.place(index(x, y)))] - view_.black) / (view_.white - view_.black);
        const auto grey = static_cast<unsigned char>(255 * std::clamp(share, 0.0, 1.0));
        canvas.set(x0 + x, y0 + y, grey, grey, grey);
      }
  }

  void outline(Canvas& canvas, int x0, int y0, const Points& index, const std::vector<Triangle>& triangles) const {
    for (const Triangle& t : triangles) {
      std::vector<Vec3> ends;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = index.col(t[i]), b = index.col(t[(i + 1) % 3]);
        if ((a[across_] < at_) != (b[across_] < at_))
          ends.push_back(a + (at_ - a[across_]) / (b[across_] - a[across_]) * (b - a));
      }
      if (ends.size() == 2) line(canvas, x0, y0, pixel(ends[0]), pixel(ends[1]));
    }
  }

 private:
  int main_axis(int axis) const {
    int main = 0;
    image_.axes.col(axis).cwiseAbs().maxCoeff(&main);
    return main;
  }
  double main_sign(int axis) const { return image_.axes(main_axis(axis), axis); }
  Vec3 index(double x, double y) const {
    Vec3 result;
    result[across_] = at_;
    const double along = x * pixel_ / image_.spacing[right_], above = y * pixel_ / image_.spacing[up_];
    result[right_] = mirrored_ ? view_.high[right_] - along : view_.low[right_] + along;
    result[up_] = upside_down_ ? view_.high[up_] - above : view_.low[up_] + above;
    return result;
  }
  Eigen::Vector2d pixel(const Vec3& index) const {
    const double along = mirrored_ ? view_.high[right_] - index[right_] : index[right_] - view_.low[right_];
    const double above = upside_down_ ? view_.high[up_] - index[up_] : index[up_] - view_.low[up_];
    return {along * image_.spacing[right_] / pixel_, above * image_.spacing[up_] / pixel_};
  }
  static void line(Canvas& canvas, int x0, int y0, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const int steps = 1 + static_cast<int>(2 * (b - a).cwiseAbs().maxCoeff());
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector2d x = a + static_cast<double>(i) / steps * (b - a);
      canvas.set(x0 + static_cast<int>(x[0]), y0 + static_cast<int>(x[1]), 230, 30, 30);
    }
  }

  const ImageVolume& image_;
  const View& view_;
  int across_, right_, up_;
  double at_, pixel_ = 1;  ///< the slice's index; length of a pixel [cm]
  bool mirrored_ = false, upside_down_ = false;
};

}  // namespace

void draw_slices(const std::filesystem::path& png, const ImageVolume& image, const RawSurface& surface) {
  Points index(3, surface.points.cols());
  for (Eigen::Index i = 0; i < index.cols(); ++i) index.col(i) = image.index(surface.points.col(i));
  const View view = view_of(image, index);
  const Vec3 low = index.rowwise().minCoeff(), high = index.rowwise().maxCoeff();
  Canvas canvas(3 * panel + 2 * gap, 3 * panel + 2 * gap);
  for (int across = 0; across < 3; ++across)
    for (int i = 0; i < 3; ++i) {
      const Slice slice(image, view, across, low[across] + (i + 1) / 4.0 * (high - low)[across]);
      const int x = i * (panel + gap), y = across * (panel + gap);
      slice.draw(canvas, x, y);
      slice.outline(canvas, x, y, index, surface.triangles);
    }
  canvas.write(png);
}

}  // namespace tether
