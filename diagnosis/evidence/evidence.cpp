#include "diagnosis/evidence/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "diagnosis/evidence/curvature.hpp"

namespace tether {
namespace {

Eigen::Matrix3Xd as_columns(const std::vector<Vec3>& list) {
  Eigen::Matrix3Xd all(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = list[i];
  return all;
}

}  // namespace

Evidence::Evidence(const Observations& data, const LumenSurface& lumen, const FinishedMotion& base)
    : sources_(data.all()),
      lumen_(lumen),
      nodal_curvature_(tether::curvatures(lumen)),
      region_names_(lumen.region_names) {
  for (const bool is_record : {false, true})
    for (std::size_t number = 0; number < sources_.size(); ++number)
      for (const MeasuredPart& part : sources_[number]->parts(base))
        if (part.is_record == is_record) add(number, part, base);
  normals_ = as_columns(normal_list_);
  places_ = as_columns(place_list_);
}

void Evidence::add(std::size_t number, const MeasuredPart& measured, const FinishedMotion& base) {
  const std::vector<Datum> data = sources_[number]->data(base, measured);
  const double deviation = sources_[number]->facts().noise.deviation;
  Part part;
  static_cast<MeasuredPart&>(part) = measured;
  part.source = number;
  part.first = static_cast<Eigen::Index>(residual_.size());
  part.count = static_cast<Eigen::Index>(data.size());
  for (const Datum& datum : data) add_datum(datum, deviation);
  measured.is_record ? number_record(data) : number_frame(data);
  parts_.push_back(part);
}

void Evidence::add_datum(const Datum& datum, double deviation) {
  residual_.push_back(datum.residual);
  independent_.push_back(datum.independent);
  precision_.push_back(datum.independent / std::pow(deviation, 2));  // (K.5)
  held_out_.push_back(datum.held_out);
  region_.push_back(datum.region);
  component_.push_back(datum.component);
  normal_list_.push_back(datum.normal);
  place_list_.push_back(datum.position);
  along_.push_back(along_vessel(datum));
  times_.push_back(datum.time);
  shown_.push_back(datum.shown);
  curvature_.push_back(datum.shares.dot(Vec3(nodal_curvature_(datum.nodes))));
}

/// Each patch of a frame is a block of its own.
void Evidence::number_frame(const std::vector<Datum>& data) {
  std::map<std::array<int, 4>, int> block_of;
  for (const Datum& datum : data) {
    const auto [place, is_new] = block_of.try_emplace(datum.patch, blocks_);
    if (is_new) ++blocks_;
    block_.push_back(place->second);
  }
}

/// Values next to the same frame are a block, held out with it.
void Evidence::number_record(const std::vector<Datum>& data) {
  const std::size_t none = parts_.size();
  std::size_t last = none + 1, row = block_.size();
  for (const Datum& datum : data) {
    const std::size_t phase = closest_frame(datum.time);
    if (phase != last) ++blocks_;
    last = phase;
    block_.push_back(blocks_);
    if (phase < none && parts_[phase].frame.held_out) held_out_[row] = true;
    ++row;
  }
  ++blocks_;
}

double Evidence::along_vessel(const Datum& datum) const {
  if (datum.shares.isZero()) return 0;
  double from = 0, to = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    from += datum.shares(static_cast<Eigen::Index>(k)) * lumen_.from_inlet(datum.nodes[k]);
    to += datum.shares(static_cast<Eigen::Index>(k)) * lumen_.from_outlet(datum.nodes[k]);
  }
  return from + to > 0 && std::isfinite(from + to) ? from / (from + to) : 0.5;
}

/// The number of the part whose moment is closest; as many as there are if none is a frame.
std::size_t Evidence::closest_frame(double time) const {
  std::size_t best = parts_.size();
  for (std::size_t k = 0; k < parts_.size(); ++k)
    if (!parts_[k].is_record &&
        (best == parts_.size() || std::abs(parts_[k].time - time) < std::abs(parts_[best].time - time)))
      best = k;
  return best;
}

int Evidence::moment_of(const Part& part) const {
  return static_cast<int>(part.is_record ? parts_.size() + part.source : closest_frame(part.time));
}

double Evidence::distance_from(const Points& lumen, const Part& part) const {
  FinishedMotion still;
  still.motion.positions = [&lumen](double) { return lumen; };
  double squares = 0, weight = 0;
  for (const Datum& datum : source(part).data(still, part)) {
    squares += datum.independent * datum.residual * datum.residual;
    weight += datum.independent;
  }
  return weight > 0 ? std::sqrt(squares / weight) : infinite;
}

MatrixXd Evidence::residuals(const std::vector<const FinishedMotion*>& runs) const {
  MatrixXd all = MatrixXd::Constant(static_cast<Eigen::Index>(residual_.size()), static_cast<Eigen::Index>(runs.size()),
                                    undefined);
  for (const Part& part : parts_)
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (runs[k]->failed()) continue;
      auto column = all.col(static_cast<Eigen::Index>(k)).segment(part.first, part.count);
      const std::vector<Datum> data = source(part).data(*runs[k], part);
      for (std::size_t i = 0; i < data.size() && static_cast<Eigen::Index>(i) < part.count; ++i)
        if (data[i].is_seen) column(static_cast<Eigen::Index>(i)) = data[i].residual;
    }
  return all;
}

EffectProblem Evidence::problem() const {
  EffectProblem problem;
  const auto n = static_cast<Eigen::Index>(residual_.size());
  problem.residual = Eigen::Map<const VectorXd>(residual_.data(), n);
  problem.precision = Eigen::Map<const VectorXd>(precision_.data(), n);
  problem.independent = Eigen::Map<const VectorXd>(independent_.data(), n);
  problem.block = block_;
  for (const Part& part : parts_)
    for (Eigen::Index i = part.first; i < part.first + part.count; ++i)
      if (precision_[static_cast<std::size_t>(i)] > 0) {
        (held_out_[static_cast<std::size_t>(i)] ? problem.held_out : problem.training).push_back(i);
        if (source(part).facts().held_out) problem.sealed.push_back(i);
      }
  problem.changes.resize(n, 0);
  problem.allowed.resize(n, 0);
  problem.patterns.resize(n, 0);
  return problem;
}

}  // namespace tether
