#pragma once

#include <numbers>

#include "diagnosis/comparison/discrepancy.hpp"
#include "observation_manager/measurements/contour_series.hpp"
#include "observation_manager/measurements/surface_series.hpp"
#include "tests/observation_manager/lumens.hpp"

/// A tube about the z axis, radius 1, length 4, with the regions "right" (x > 0) and "left", whose radius beats with
/// period 1; and surfaces and contours of it.
namespace tether::testing {

inline double growth(double time) {
  return 0.1 * (1 - std::cos(2 * std::numbers::pi * time));
}

/// How far the tube's facets lie within its circle at most, when it is widest.
inline const double sag = 1.2 * (1 - std::cos(std::numbers::pi / 48));

inline TriangleSurface tube_at(double time, const Vec3& shift = Vec3::Zero()) {
  TriangleSurface surface = tube(48, 24, 4, [&](double) { return 1 + growth(time); });
  surface.points.colwise() += shift;
  return surface;
}

inline LumenSurface beating_lumen() {
  LumenSurface surface = lumen(tube_at(0));
  surface.region_names = {"right", "left"};
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i)
    surface.region[static_cast<std::size_t>(i)] = surface.points(0, i) > 0 ? 0 : 1;
  return surface;
}

/// A run from 0 to `end` that beats, shifted from the start on by `shift`.
inline RunMotion beating_run(double end, const Vec3& shift = Vec3::Zero()) {
  return {0, end, tube_at(0).points, [shift](double time) { return tube_at(time, shift).points; }};
}

inline SourceSettings beating_settings(const LumenSurface& surface, Noise noise) {
  SourceSettings settings = settings_for(surface);
  settings.period = 1;
  settings.noise = noise;
  return settings;
}

/// Surfaces of the tube at eighths of a period; frames 2 and 5 held out.
inline SurfaceSeries beating_surfaces(Noise noise = {}, double period = 1) {
  const LumenSurface surface = beating_lumen();
  SourceSettings settings = beating_settings(surface, noise);
  settings.period = period;
  std::vector<SurfaceFrame> frames;
  for (int i = 0; i < 8; ++i) frames.push_back({i / 8.0, tube_at(i / 8.0), {}});
  return {settings, frames, {false, false, true, false, false, true, false, false}, surface};
}

/// Two slices of the tube at quarters of a period, across the axis, displaced in the plane by `shift`.
inline ContourSeries beating_contours(Noise noise, const Vec2& shift) {
  const LumenSurface surface = beating_lumen();
  std::vector<ContourTrack> tracks;
  for (const double z : {1.03, 2.97}) {
    ContourTrack track{
        z < 2 ? "slice low" : "slice high", {Vec3(0, 0, z), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {}, {}};
    for (int i = 0; i < 4; ++i) {
      Eigen::Matrix2Xd circle(2, 360);
      for (int k = 0; k < 360; ++k)
        circle.col(k) = shift + (1 + growth(i / 4.0)) *
                                    Vec2(std::cos(k * std::numbers::pi / 180), std::sin(k * std::numbers::pi / 180));
      track.times.push_back(i / 4.0);
      track.contours.emplace_back(circle, true);
    }
    tracks.push_back(track);
  }
  return {beating_settings(surface, noise), tracks, 64, surface};
}

}  // namespace tether::testing
