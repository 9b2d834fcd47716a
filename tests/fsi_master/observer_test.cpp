#include "fsi_master/observer.hpp"

#include <gtest/gtest.h>

#include "tests/fsi_master/fakes.hpp"

// The observer against partners of a few lines: what it asks of whom, and what it does when the blood's mesh breaks.
namespace tether {
namespace {

/// Every node lies 1 inside the data, along x.
struct OneAway : ObservationPartner {
  Later<Innovation> observe(double time, const VectorXd& points) override {
    asked.emplace_back(time, points[0]);
    Innovation data{VectorXd::Ones(points.size() / 3), VectorXd::Ones(points.size() / 3),
                    VectorXd::Zero(points.size())};
    for (Eigen::Index a = 0; a < points.size(); a += 3) data.normals[a] = 1;
    return Later<Innovation>(std::move(data));
  }
  std::vector<std::pair<double, double>> asked;
};

/// Moves by a tenth of the distance; remembers what was taken back.
struct ObservedSolid : fake::Solid {
  using fake::Solid::Solid;
  bool has_observer() const override { return true; }
  Later<VectorXd> correct(double, const Innovation& data) override {
    moved = 0.1;
    VectorXd change = VectorXd::Zero(data.normals.size());
    for (Eigen::Index a = 0; a < data.distances.size(); ++a)
      change.segment<3>(3 * a) = 0.1 * data.distances[a] * data.normals.segment<3>(3 * a);
    return Later<VectorXd>(std::move(change));
  }
  Later<VectorXd> set_drift(const Innovation& data) override {
    VectorXd rate = VectorXd::Zero(data.normals.size());
    for (Eigen::Index a = 0; a < data.distances.size(); ++a)
      rate.segment<3>(3 * a) = 10 * data.distances[a] * data.normals.segment<3>(3 * a);
    return Later<VectorXd>(std::move(rate));
  }
  Later<Done> withdraw(double share) override {
    moved *= 1 - share;
    return Later<Done>(Done{});
  }
  double moved = 0;
};

/// A mesh that follows motions up to a size.
struct BrittleFluid : fake::Fluid {
  using fake::Fluid::Fluid;
  bool has_observer() const override { return true; }
  Later<Done> move_interface(const VectorXd& change) override {
    if (change.cwiseAbs().maxCoeff() > largest) throw StepFailure("element 7 would fold");
    followed = change.cwiseAbs().maxCoeff();
    return Later<Done>(Done{});
  }
  double largest = 1, followed = 0;
};

struct Observed {
  OneAway data;
  fake::Vessel vessel{.interface_nodes = 2, .inner_nodes = 2};
  BrittleFluid fluid{vessel};
  ObservedSolid solid{vessel};
  VectorXd rest = VectorXd::Constant(6, 5.0);
  Observer observer{data, fluid, solid, Observer::Form::split, rest};
};

TEST(Observer, AsksWhereTheWallIsAndMovesWallAndMeshAlike) {
  Observed o;
  const VectorXd change = o.observer.correct(0.3, 0.01, VectorXd::Constant(6, 0.25));
  EXPECT_EQ(o.data.asked, (std::vector<std::pair<double, double>>{{0.3, 5.25}}));
  EXPECT_EQ(change[0], 0.1);
  EXPECT_EQ(change[1], 0);
  EXPECT_EQ(o.fluid.followed, 0.1);
  EXPECT_EQ(o.solid.moved, 0.1);
  EXPECT_EQ(o.observer.statistics().corrections, 1);
  EXPECT_EQ(o.observer.statistics().weakened, 0);
  EXPECT_EQ(o.observer.statistics().largest, 0.1);
}

TEST(Observer, HalvesWhatTheMeshCannotFollow) {
  Observed o;
  o.fluid.largest = 0.03;
  const VectorXd change = o.observer.correct(0, 0.01, VectorXd::Zero(6));
  EXPECT_NEAR(change[0], 0.025, 1e-15);
  EXPECT_NEAR(o.solid.moved, 0.025, 1e-15);
  EXPECT_EQ(o.observer.statistics().weakened, 2);
}

TEST(Observer, HalvesADriftThatTheMeshCannotFollow) {
  Observed o;
  o.fluid.largest = 0.03;
  const VectorXd rate = o.observer.begin_drift(0, 0.01, VectorXd::Zero(6));
  EXPECT_NEAR(rate[0], 2.5, 1e-12);
  EXPECT_NEAR(o.fluid.followed, 0.025, 1e-15);
  EXPECT_NEAR(o.observer.drift(0, VectorXd::Zero(6))[0], 2.5, 1e-12) << "for the whole step";
  EXPECT_EQ(o.observer.statistics().weakened, 2);
  o.fluid.largest = 1e-9;
  EXPECT_EQ(o.observer.begin_drift(0, 0.01, VectorXd::Zero(6)).norm(), 0);
  o.fluid.largest = 1;
  EXPECT_NEAR(o.observer.begin_drift(0, 0.01, VectorXd::Zero(6))[0], 10, 1e-12) << "each step anew";
}

TEST(Observer, GivesUpACorrectionThatNoMeshFollows) {
  Observed o;
  o.fluid.largest = 1e-9;
  EXPECT_EQ(o.observer.correct(0, 0.01, VectorXd::Zero(6)).norm(), 0);
  EXPECT_EQ(o.solid.moved, 0);
}

}  // namespace
}  // namespace tether
