#include <gtest/gtest.h>

#include "common/mesh/surface.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "observation_manager/server.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/protocol/in_process.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/coupled_vessel.hpp"
#include "tests/scenarios/surface_file.hpp"
#include "twin/noise.hpp"

/// The state observer on a coarse configs/tube: a twin whose wall starts in the wrong place finds back to the truth.
namespace tether {
namespace {

namespace fs = std::filesystem;

/// Measurements without error: where the lumen of a run was, linear between its steps. Node by node, along its normals.
class KnownLumen : public ObservationPartner {
 public:
  KnownLumen(Points rest, std::vector<Triangle> triangles, double start, double dt)
      : rest_(std::move(rest)), triangles_(std::move(triangles)), start_(start), dt_(dt) {}
  void add(const Points& displacement) { moved_.push_back(displacement); }

  Points at(double time) const {
    const double s = std::clamp((time - start_) / dt_, 0.0, static_cast<double>(moved_.size() - 1));
    const auto k = std::min(static_cast<std::size_t>(s), moved_.size() - 2);
    const double share = s - static_cast<double>(k);
    return rest_ + (1 - share) * moved_[k] + share * moved_[k + 1];
  }
  Later<Innovation> observe(double time, const VectorXd& points) override {
    const Points truth = at(time), way = truth - points.reshaped(3, truth.cols()), n = nodal_normals(truth, triangles_);
    Innovation data{nodal_areas(truth, triangles_), n.cwiseProduct(way).colwise().sum().transpose(), n.reshaped()};
    return Later<Innovation>(std::move(data));
  }
  /// Root mean square of the distances, over the area.
  double distance(double time, const Points& displacement) {
    const Innovation data = observe(time, (rest_ + displacement).reshaped()).get();
    return std::sqrt(data.weights.dot(data.distances.cwiseAbs2()) / data.weights.sum());
  }

 private:
  Points rest_;
  std::vector<Triangle> triangles_;
  double start_, dt_;
  std::vector<Points> moved_;
};

/// Data that are somewhere else than the model once, all along.
class Elsewhere : public ObservationPartner {
 public:
  Elsewhere(KnownLumen& truth, Points rest) : truth_(truth), rest_(std::move(rest)) {}
  /// Wider by 1 mm on one side, narrower on the other.
  Later<Innovation> observe(double time, const VectorXd& points) override {
    Innovation data = truth_.observe(time, points).get();
    for (Eigen::Index a = 0; a < data.distances.size(); ++a)
      data.distances[a] = 0.1 * std::sin(std::numbers::pi * rest_(2, a) / 10) * (0.3 + rest_(0, a) / 2);
    return Later<Innovation>(std::move(data));
  }

 private:
  KnownLumen& truth_;
  Points rest_;
};

class ObservedTube : public ::testing::Test {
 protected:
  std::filesystem::path tube(double gain, double dt) const {
    return case_variant(
        TETHER_SOURCE "/configs/tube/case.yaml", folder / fmt::format("{}_{}", gain, dt),
        {{"around: 24", "around: 12"},
         {"along: 20", "along: 12"},
         {"step: 2e-3", fmt::format("step: {}", dt)},
         {"coupling: {tolerance: 1e-6}", fmt::format("coupling: {{tolerance: 1e-8}}\nobserver: {{gain: {}}}", gain)}});
  }

  /// A truth from `begin` on, `steps` long, and the vessel that starts it.
  struct Truth {
    std::unique_ptr<CoupledVessel> start;
    std::unique_ptr<KnownLumen> lumen;
  };
  Truth truth(double gain, double dt, double begin, int steps) const {
    Truth truth{std::make_unique<CoupledVessel>(tube(gain, dt)), nullptr};
    truth.start->advance(static_cast<int>(std::lround(begin / dt)));
    CoupledVessel on(tube(gain, dt));
    on.stand_where(*truth.start);
    truth.lumen = std::make_unique<KnownLumen>(on.reference(), on.triangles(), on.time(), dt);
    truth.lumen->add(on.displacement());
    for (int k = 0; k < steps; ++k) {
      on.advance();
      truth.lumen->add(on.displacement());
    }
    return truth;
  }

  TemporaryFolder folder;
};

/// Starts where the truth starts, but with the wall moved by a correction toward data that are elsewhere.
void move_away(CoupledVessel& vessel, KnownLumen& truth) {
  Elsewhere wrong(truth, vessel.reference());
  vessel.correct_once(wrong, 1e3);
}

TEST_F(ObservedTube, FindsBackAtLeastAsFastAsItsGain) {
  const double dt = 2e-3, begin = 0.1;
  const int steps = 60;
  for (const double gain : {3.0, 15.0, 60.0}) {
    const Truth known = truth(gain, dt, begin, steps);
    CoupledVessel model(tube(gain, dt));
    model.stand_where(*known.start);
    move_away(model, *known.lumen);
    model.observe(*known.lumen, Observer::Form::split);
    const double first = known.lumen->distance(model.time(), model.displacement());
    ASSERT_GT(first, 0.02);
    for (int k = 1; k <= steps; ++k) {
      model.advance();
      // The pressures and flows that the wrong wall made are not corrected: they go on pushing, by micrometres.
      const double expected = first * std::max(std::exp(-gain * k * dt), 0.01),
                   d = known.lumen->distance(model.time(), model.displacement());
      if (k % 20 == 0)
        std::printf("| gamma %g 1/s, after %g s | %.4f of the first distance | exp(-gamma t) %.4f |\n", gain, k * dt,
                    d / first, std::exp(-gain * k * dt));
      EXPECT_LE(d, expected) << "gain " << gain << ", step " << k;
    }
  }
}

/// As users have it: noisy surfaces in files, ten milliseconds apart, through the observation manager's own server.
TEST_F(ObservedTube, FindsBackToNoisySurfacesDownToTheirNoise) {
  const double dt = 2e-3, begin = 0.1, apart = 0.01, deviation = 0.01, along = 0.5;
  const int steps = 60;
  for (const double gain : {3.0, 15.0, 60.0}) {
    const Truth known = truth(gain, dt, begin, steps);
    CoupledVessel model(tube(gain, dt));
    model.stand_where(*known.start);
    std::vector<double> times;
    for (double t = begin; t < begin + steps * dt + apart; t += apart) times.push_back(t);
    const NoiseSeries noise({deviation, along, 0}, times, 1);
    std::string list = "file, time [s]\n";
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Points x = known.lumen->at(times[k]), n = nodal_normals(x, model.triangles());
      const std::string name = fmt::format("frame_{}_{}.stl", gain, k);
      write_stl(folder / name, x + n * noise(k, x).asDiagonal(), model.triangles());
      list += fmt::format("{}, {}\n", name, times[k]);
    }
    folder.file("frames.csv", list);
    const fs::path measured = case_variant(
        tube(gain, dt), folder / fmt::format("measured_{}", gain),
        {{"output:", fmt::format("observations: {{surfaces: {{ct: {{file: {}/frames.csv, unit: cm}}}}}}\noutput:",
                                 folder.path().string())}});
    const ObservedCase observed(measured);
    protocol::Partner manager = protocol::in_process_partner<protocol::ToObservation>(
        "observation_manager",
        std::make_shared<ObservationServer>(load_observations(observed.observations, observed.lumen(), observed.file),
                                            model.reference().cols(), "{}"));
    MessageObservation data(manager);
    move_away(model, *known.lumen);
    model.observe(data, Observer::Form::split);
    const double first = known.lumen->distance(model.time(), model.displacement());
    ASSERT_GT(first, 2 * deviation);
    for (int k = 1; k <= steps; ++k) {
      model.advance();
      const double left = known.lumen->distance(model.time(), model.displacement());
      if (k % 20 == 0)
        std::printf(
            "| gamma %g 1/s, noisy surfaces, after %g s | %.4f of the first distance | noise %.4f | exp(-gamma t) %.4f "
            "|\n",
            gain, k * dt, left / first, deviation / first, std::exp(-gain * k * dt));
      EXPECT_LE(left, first * std::exp(-gain * k * dt) + deviation) << "gain " << gain << ", step " << k;
    }
  }
}

/// Both forms of the observer from the same wrong start; how far apart they are after 0.04 s.
TEST_F(ObservedTube, SplitAndMonolithicAgreeAsTheStepGoesToZero) {
  const double gain = 15, begin = 0.1, duration = 0.04;
  std::vector<double> apart;
  for (const double dt : {4e-3, 2e-3, 1e-3}) {
    const int steps = static_cast<int>(std::lround(duration / dt));
    const Truth known = truth(gain, dt, begin, steps);
    CoupledVessel split(tube(gain, dt)), monolithic(tube(gain, dt));
    for (const auto& [model, form] :
         {std::pair{&split, Observer::Form::split}, {&monolithic, Observer::Form::monolithic}}) {
      model->stand_where(*known.start);
      move_away(*model, *known.lumen);
      model->observe(*known.lumen, form);
    }
    const double first = known.lumen->distance(split.time(), split.displacement());
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
      split.advance();
      monolithic.advance();
      sum += (split.displacement() - monolithic.displacement()).squaredNorm() /
             static_cast<double>(split.reference().cols());
    }
    apart.push_back(std::sqrt(sum / steps) / first);
    std::printf("| split and monolithic observer, dt %g s | apart by %.3e of the first distance |\n", dt, apart.back());
  }
  EXPECT_LT(apart.back(), 0.01);
  for (std::size_t i = 1; i < apart.size(); ++i) EXPECT_GT(std::log2(apart[i - 1] / apart[i]), 0.85);
}

}  // namespace
}  // namespace tether
