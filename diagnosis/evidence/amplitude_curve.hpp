#pragma once

#include <vector>

#include "common/base/effect.hpp"
#include "common/base/types.hpp"

namespace tether {

/// Factor of sizes within which a run tells what a size does.
inline constexpr double near_a_run = 1.35;

/// What a candidate of one amplitude does to the data on one side of zero, as runs showed it.
class AmplitudeCurve {
 public:
  /// What a run showed: at its size the data change by `factor` times a column.
  struct Point {
    double size;
    Eigen::Index column;
    double factor = 1;
    bool is_coarse = false;  ///< of a coarser model
  };
  /// So much of what a point's run showed.
  struct Share {
    const Point* point;
    double share;
  };

  /// Unless the same model was run at that size before.
  void add(const Point& point);
  /// What a coarser model shows is scaled as runs of the model itself want it; the smallest and the largest run say how
  /// the effect saturates. columns: of all runs, each [n]; precision [n].
  void settle(const MatrixXd& columns, const VectorXd& precision);

  /// By magnitude.
  const std::vector<Point>& points() const { return points_; }
  /// In proportion to size/(size + s) up to the smallest run, linear in it between runs, and beyond them as from the
  /// first to the last. Where a coarser model was run too: so of its runs, and what those of the model itself differ
  /// from that, between them, and as at the last beyond. Empty if no run was made.
  std::vector<Share> at(double size) const;

  /// Whether both models were run.
  bool differs_from_coarse() const { return !fine_.empty(); }
  /// Of the largest run of the model itself.
  double largest() const { return fine_.back().size; }
  /// What that run showed less what the coarser model shows at its size, as it is.
  std::vector<Share> from_coarse() const;

 private:
  using Points = std::vector<Point>;

  void scale_coarse(const MatrixXd& columns, const VectorXd& precision);
  std::vector<Share> along(const Points& points, double size) const;
  void note_saturation(const Points& points, const MatrixXd& columns, const VectorXd& precision);
  double saturated(double size) const;

  Points points_;
  Points coarse_, fine_;       ///< where both models were run
  double coarse_times_ = 1;    ///< so many times what the coarser model shows is taken for what the effect does
  double half_at_ = infinite;  ///< s, at which the effect does half of what it ever does; infinite: in proportion
};

}  // namespace tether
