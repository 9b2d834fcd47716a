#include "diagnosis/comparison/slices.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "observation_manager/measurements/contour_series.hpp"
#include "observation_manager/measurements/surface_series.hpp"

namespace tether {
namespace {

Points closed_line(const Points& points, bool closed) {
  Points line(3, points.cols() + (closed ? 1 : 0));
  line << points, points.leftCols(closed ? 1 : 0);
  return line;
}

Lines cut(const Points& x, const std::vector<Triangle>& triangles, const SlicePlane& plane) {
  Lines lines;
  for (const CutPiece& piece : cut_by_plane(x, triangles, plane))
    lines.push_back(closed_line(piece.points, piece.closed));
  return lines;
}

SliceView view_of(const std::string& name, const SlicePlane& plane, const LumenSurface& lumen, const Points& now) {
  return {name, plane, cut(now, lumen.triangles, plane), cut(lumen.points, lumen.triangles, plane), {}, {}};
}

SliceView contour_view(const ContourSeries& data, const Frame& frame, const LumenSurface& lumen, const Points& now) {
  const ContourTrack& track = data.tracks()[static_cast<std::size_t>(frame.series)];
  SliceView view = view_of(track.name, track.plane, lumen, now);
  const Contour& contour = track.contours[frame.number];
  Points points(3, contour.points().cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = track.plane.origin + track.plane.lifted(contour.points().col(i));
  view.data = {closed_line(points, contour.closed())};
  view.samples = data.observe(now, frame);
  return view;
}

/// Planes across the direction in which the vessel is longest.
std::vector<SlicePlane> planes_across(const Points& x) {
  const Points from_centre = x.colwise() - x.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(from_centre * from_centre.transpose());
  const Vec3 along = axes.eigenvectors().col(2), e1 = axes.eigenvectors().col(1);
  const Eigen::RowVectorXd height = along.transpose() * x;
  std::vector<SlicePlane> planes;
  for (const double share : {0.25, 0.5, 0.75}) {
    const double at = height.minCoeff() + share * (height.maxCoeff() - height.minCoeff());
    const Vec3 centre = x.rowwise().mean();
    planes.push_back({centre + (at - along.dot(centre)) * along, e1, along.cross(e1), along});
  }
  return planes;
}

std::vector<SliceView> surface_views(const SurfaceSeries& data, const Frame& frame, const LumenSurface& lumen,
                                     const Points& now) {
  const TriangleSurface& measured = data.surface(frame);
  std::vector<SliceView> views;
  for (const SlicePlane& plane : planes_across(lumen.points)) {
    SliceView view = view_of("plane " + std::to_string(views.size() + 1), plane, lumen, now);
    view.data = cut(measured.points, measured.triangles, plane);
    views.push_back(std::move(view));
  }
  return views;
}

/// The moment at which the group of all samples has the largest value.
template <class Value>
const Moment* largest(const SourceDiscrepancy& source, const Value& value) {
  const auto& all = source.moments;
  const auto found = std::max_element(all.begin(), all.end(), [&](const Moment& a, const Moment& b) {
    return value(*group_of_region(a, -1)) < value(*group_of_region(b, -1));
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::vector<SliceView> slices_at(const Moment& moment, const LumenSeries& data, const LumenSurface& lumen,
                                 const RunMotion& run) {
  const Points now = run.positions(moment.time);
  if (const auto* surfaces = dynamic_cast<const SurfaceSeries*>(&data))
    return surface_views(*surfaces, moment.frames.front(), lumen, now);
  std::vector<SliceView> views;
  for (const Frame& frame : moment.frames)
    views.push_back(contour_view(dynamic_cast<const ContourSeries&>(data), frame, lumen, now));
  return views;
}

const Moment* worst_moment(const SourceDiscrepancy& source) {
  return largest(source, [](const Group& group) { return group.model.rms; });
}

const Moment* fullest_moment(const SourceDiscrepancy& source) {
  return largest(source, [](const Group& group) { return group.apparent.mean; });
}

VectorXd distance_at_nodes(const Moment& moment, const LumenSeries& data, const RunMotion& run) {
  const Points now = run.positions(moment.time);
  VectorXd sum = VectorXd::Zero(now.cols()), weight = sum;
  for (const Frame& frame : moment.frames)
    for (const Sample& sample : data.observe(now, frame))
      for (std::size_t i = 0; i < 3; ++i) {
        const double share = sample.weight * sample.shares[static_cast<Eigen::Index>(i)];
        sum[sample.nodes[i]] += share * sample.distance;
        weight[sample.nodes[i]] += share;
      }
  for (Eigen::Index node = 0; node < sum.size(); ++node)
    sum[node] = weight[node] > 0 ? sum[node] / weight[node] : std::numeric_limits<double>::quiet_NaN();
  return sum;
}

}  // namespace tether
