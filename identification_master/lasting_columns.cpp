#include "identification_master/lasting_columns.hpp"

#include <algorithm>

#include "observation_manager/measurements/faults/faults.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// Slots of FrameSharing::parts_at.
constexpr Index frames_at_once = std::tuple_size_v<decltype(std::declval<FrameSharing>().parts_at(0))>;

/// Series of which the values of the one and the other are seen at the same times.
bool are_together(const CountedSeries& a, const CountedSeries& b) {
  return a.times == b.times && a.period == b.period && a.tolerance == b.tolerance;
}

/// One frame is always the same.
bool has_frames(const CountedSeries& series) {
  return series.times.size() > 1;
}

void append(MatrixXd& columns, const VectorXd& values) {
  columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
  columns.rightCols(1) = values;
}

}  // namespace

/// Errors of one source, whose rows stand among all from `first` on.
class LastingColumns::OfSource {
 public:
  OfSource(LastingColumns& all, const Measurement& source, const CountedRows& rows, Index first)
      : all_(all), facts_(source.facts()), rows_(rows), first_(first) {}

  void add_faults(const LastingAllowance& lasting) {
    AllowanceCase allowed;
    static_cast<LastingAllowance&>(allowed) = lasting;
    const SourceData still = data();
    for (const auto& fault : Faults(facts_.kind.fallible)) {
      if (fault->declaration().on_request) continue;
      const double deviation = fault->allowed(allowed, facts_.noise.deviation);
      const FaultColumns columns = deviation > 0 ? fault->columns(still) : FaultColumns{};
      for (Index k = 0; k < columns.values.cols(); ++k)
        add(columns.numbers[static_cast<std::size_t>(k)].name, deviation, columns.values.col(k));
    }
  }

  void add_regions(double deviation, const std::vector<std::string>& names) {
    for (std::size_t region = 0; deviation > 0 && region < names.size(); ++region)
      add(names[region], deviation, inside(static_cast<int>(region), nullptr));
  }

  void add_regions_in_frames(double deviation, const std::vector<std::string>& names, const StepEnds& ends) {
    std::vector<const CountedSeries*> told;
    for (const CountedSeries& series : rows_.series) {
      const auto as_before = [&](const CountedSeries* other) { return are_together(series, *other); };
      if (!(deviation > 0) || !has_frames(series) || std::any_of(told.begin(), told.end(), as_before)) continue;
      told.push_back(&series);
      MatrixXd columns(all_.values_.rows(), 0);
      for (std::size_t region = 0; region < names.size(); ++region)
        if (const VectorXd values = inside(static_cast<int>(region), &series); !values.isZero(0))
          append(columns, among_all(deviation * values));
      all_.of_frames_.push_back({FrameSharing(series.times, series.period, series.tolerance, ends), columns});
    }
  }

 private:
  Index rows() const { return std::ssize(rows_.series_of); }
  SourceData data() const {
    const VectorXd none = VectorXd::Zero(rows());
    return {rows_.positions, rows_.normals, none, none, none};
  }
  /// 1 where a region is, in series that are seen together with one, or in all.
  VectorXd inside(int region, const CountedSeries* together) const {
    VectorXd values(rows());
    for (Index row = 0; row < rows(); ++row) {
      const auto i = static_cast<std::size_t>(row);
      const bool counts = together == nullptr || are_together(*together, rows_.series[rows_.series_of[i]]);
      values(row) = counts && rows_.region[i] == region ? 1 : 0;
    }
    return values;
  }
  VectorXd among_all(const VectorXd& values) const {
    VectorXd all = VectorXd::Zero(all_.values_.rows());
    all.segment(first_, rows()) = values;
    return all;
  }
  /// Unless it does nothing.
  void add(const std::string& name, double deviation, const VectorXd& values) {
    if (values.isZero(0)) return;
    append(all_.values_, among_all(deviation * values));
    all_.errors_.push_back({facts_.field(), name, deviation});
  }

  LastingColumns& all_;
  MeasurementFacts facts_;
  const CountedRows& rows_;
  Index first_;
};

LastingColumns::LastingColumns(const Observations& data, const LumenSurface& lumen, const Points& imaged,
                               const LastingAllowance& allowed, const StepEnds& ends) {
  std::vector<CountedRows> rows;
  Index count = 0;
  for (const Measurement* source : data.all()) {
    rows.push_back(source->rows(imaged, ends.start));
    count += std::ssize(rows.back().series_of);
  }
  values_.resize(count, 0);
  Index first = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MeasurementFacts facts = data.all()[i]->facts();
    if (rows[i].normals.cols() > 0 && !facts.held_out) {
      const double of_model = allowed.of_model(facts.noise.deviation);
      OfSource columns(*this, *data.all()[i], rows[i], first);
      columns.add_faults(allowed);
      columns.add_regions(of_model, lumen.region_names);
      columns.add_regions_in_frames(of_model, lumen.region_names, ends);
    }
    first += std::ssize(rows[i].series_of);
  }
}

Index LastingColumns::count() const {
  Index all = values_.cols();
  for (const FrameColumns& of : of_frames_) all += frames_at_once * of.values.cols();
  return all;
}

MatrixXd LastingColumns::at(double time) const {
  MatrixXd all(values_.rows(), count());
  all.leftCols(values_.cols()) = values_;
  Index first = values_.cols();
  for (const FrameColumns& of : of_frames_)
    for (const FramePart& seen : of.frames.parts_at(time)) {
      all.middleCols(first, of.values.cols()) = seen.part * of.values;
      first += of.values.cols();
    }
  return all;
}

std::vector<Index> LastingColumns::renewed(double before, double time) const {
  std::vector<Index> all;
  Index first = values_.cols();
  for (const FrameColumns& of : of_frames_) {
    const auto then = of.frames.parts_at(before), now = of.frames.parts_at(time);
    for (std::size_t slot = 0; slot < now.size(); ++slot)
      for (Index k = 0; k < of.values.cols(); ++k, ++first)
        if (then[slot].frame != now[slot].frame) all.push_back(first);
  }
  return all;
}

}  // namespace tether
