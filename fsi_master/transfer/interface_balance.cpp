#include "fsi_master/transfer/interface_balance.hpp"

#include <Eigen/Geometry>

namespace tether {
namespace {

struct Sums {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double work = 0, forces = 0, moments = 0, works = 0;  ///< the last three of sizes
};

Sums sums_of(const InterfaceSide& side, const Vec3& middle) {
  Sums sums;
  for (Eigen::Index a = 0; a < side.points.cols(); ++a) {
    const Vec3 f = side.forces.segment<3>(3 * a), r = side.points.col(a) - middle;
    const double work = f.dot(side.motions.segment<3>(3 * a));
    sums.force += f, sums.forces += f.norm();
    sums.moment += r.cross(f), sums.moments += r.norm() * f.norm();
    sums.work += work, sums.works += std::abs(work);
  }
  return sums;
}

double share(double difference, double whole) {
  return whole > 0 ? difference / whole : 0.0;
}

}  // namespace

InterfaceBalance balance(const InterfaceSide& fluid, const InterfaceSide& solid) {
  const Vec3 middle = fluid.points.rowwise().mean();
  const Sums there = sums_of(fluid, middle), here = sums_of(solid, middle);
  return {share((there.force - here.force).norm(), there.forces),
          share((there.moment - here.moment).norm(), there.moments),
          share(std::abs(there.work - here.work), there.works)};
}

}  // namespace tether
