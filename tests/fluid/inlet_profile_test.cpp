// Inlet profiles: the exact flux, the developed flows on a disc, and the Womersley flow they start.
#include <gtest/gtest.h>

#include <numbers>

#include "common/base/error.hpp"
#include "tests/fluid/fluid_testing.hpp"
#include "tests/fluid/womersley.hpp"

namespace tether::fluid::testing {
namespace inlet_profile_test {

constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;

EndFace disc(int around) {
  const FluidMesh mesh = tube(1, 1, around, 2);
  return EndFace(mesh.inlets[0], mesh, nodes_of(mesh.interface));
}

Points face_points(const EndFace& face, int around) {
  return face.local(tube(1, 1, around, 2).points);
}

double profile_error(int around, Complex alpha) {
  const EndFace face = disc(around);
  const auto psi = face.developed_profile(alpha);
  const Points x = face_points(face, around);
  double worst = 0;
  for (Eigen::Index a = 0; a < psi.size(); ++a)
    worst = std::max(worst, std::abs(psi[a] - developed_exact(alpha, x.col(a).norm())));
  return worst / std::abs(developed_exact(alpha, 0));
}

TEST(DevelopedProfile, ConvergesToTheParabolaAndToBesselsFunction) {
  for (const Complex alpha : {Complex(0, 0), Complex(0, 25)}) {
    const double coarse = profile_error(24, alpha), fine = profile_error(48, alpha);
    report(alpha == 0.0 ? "parabola" : "womersley_profile", coarse, fine);
    EXPECT_GT(order(coarse, fine), 1.6);
    EXPECT_LT(fine, 0.02);
  }
}

TEST(InletProfile, CarriesTheFlowToRoundOffAndVanishesAtTheRim) {
  EndFace face = disc(24);
  Points moved = tube(1, 1, 24, 2).points;
  moved.row(0) *= 1.3;
  moved.row(2) += 0.2 * moved.row(0);
  face.place(moved);
  const Curve curve({0, 0.3, 0.5}, {1, 8, -2}, {1.0, 0, 1});
  for (const Profile kind : {Profile::flat, Profile::parabolic, Profile::womersley}) {
    const InletProfile profile(face, kind, {curve, 1.0, 0}, 0.04);
    for (double t : {0.0, 0.2, 0.7}) {
      const Points v = profile.velocity(face, 2 * curve(t), t, 2);
      EXPECT_NEAR(-face.total_flux(v), 2 * curve(t), 1e-13);
      EXPECT_EQ(v(Eigen::all, face.rim).norm(), 0);
    }
  }
}

TEST(InletProfile, OfWomersleyNeedsAPeriod) {
  const EndFace face = disc(12);
  EXPECT_THROW(InletProfile(face, Profile::womersley, {Curve::constant(1), 0, 0}, 0.04), InputError);
}

TEST(InletProfile, WomersleyReproducesTheExactProfileInTime) {
  const EndFace face = disc(48);
  const Points x = face_points(face, 48);
  std::vector<double> times, values;
  for (int i = 0; i < 400; ++i) times.push_back(i / 400.0), values.push_back(std::cos(2 * pi * i / 400.0));
  const Curve curve(times, values, {1.0, 0, 1});
  const double nu = 0.25;
  const InletProfile profile(face, Profile::womersley, {curve, 1.0, 0}, nu);
  for (double t : {0.0, 0.13, 0.5, 0.77}) {
    const Points v = profile.velocity(face, curve(t), t, 1);
    double error = 0, scale = 0;
    for (Eigen::Index a = 0; a < x.cols(); ++a) {
      const double exact = womersley_velocity(2 * pi, nu, x.col(a).norm(), t);
      error = std::max(error, std::abs(v(2, a) - exact));
      scale = std::max(scale, std::abs(exact));
    }
    EXPECT_LT(error, 0.03 * std::max(scale, 0.3)) << t;
  }
}

}  // namespace inlet_profile_test
}  // namespace tether::fluid::testing
