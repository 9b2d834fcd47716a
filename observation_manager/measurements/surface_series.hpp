#pragma once

#include <map>
#include <memory>

#include "observation_manager/measurements/lumen_series.hpp"
#include "observation_manager/measurements/registry.hpp"
#include "observation_manager/measurements/signed_surface.hpp"

namespace tether {

/// A measured surface of the lumen at a time.
struct SurfaceFrame {
  double time = 0;
  TriangleSurface surface;
  std::vector<bool> flawed;  ///< triangles whose distance means nothing; empty: none
  double label = 0;          ///< number by which the case names it
};

/// Surfaces over time: a sample at each node of the model's lumen.
class SurfaceSeries : public LumenSeries {
 public:
  /// `frames` in the order of their times, checked (surface_check.hpp). Weights are areas of the imaged `lumen`.
  SurfaceSeries(SourceSettings settings, std::vector<SurfaceFrame> frames, const std::vector<bool>& held_out,
                const LumenSurface& lumen, std::vector<Note> notes = {});

  std::vector<Sample> observe(const Points& x, double time) const override;
  std::vector<Sample> observe(const Points& x, const Frame& frame) const override;
  std::vector<Frame> frames() const override;
  std::vector<std::string> series_names() const override { return {settings_.name}; }
  int sample_dimension() const override { return 2; }
  const MeasurementKind& kind() const override { return kinds::surfaces; }
  const TriangleSurface& surface(const Frame& frame) const { return frames_[frame.number].surface; }
  const SourceSettings& settings() const override { return settings_; }
  std::uint64_t content() const override;
  const std::vector<Note>& notes() const override { return notes_; }

 private:
  std::vector<Sample> against(const Points& x, std::size_t frame) const;
  Sample sample_of_node(Eigen::Index node, const Vec3& x) const;
  /// A frame in use, and what of it is near each node.
  struct FrameTree {
    SignedSurface surface;
    std::vector<Neighbourhood> near;
  };
  FrameTree& tree(std::size_t frame) const;

  SourceSettings settings_;
  FrameTimes times_;
  std::vector<SurfaceFrame> frames_;
  VectorXd areas_;
  std::vector<Note> notes_;
  mutable std::map<std::size_t, FrameTree> trees_;  ///< of the frames in use
};

}  // namespace tether
