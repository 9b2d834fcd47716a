#include "identification_master/lasting_columns.hpp"

#include <algorithm>

#include "observation_manager/measurements/faults/faults.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// Errors of one source, whose rows stand among all from `first` on.
class SourceColumns {
 public:
  SourceColumns(LastingColumns& all, const Measurement& source, const CountedRows& rows, Index first)
      : all_(all), facts_(source.facts()), rows_(rows), first_(first) {}

  void add_faults(const LastingAllowance& lasting) {
    AllowanceCase allowed;
    static_cast<LastingAllowance&>(allowed) = lasting;
    const SourceData still = data();
    for (const auto& fault : Faults(facts_.kind.fallible)) {
      const double deviation = fault->allowed(allowed, facts_.noise.deviation);
      if (!(deviation > 0)) continue;
      const FaultColumns columns = fault->columns(still);
      for (Index k = 0; k < columns.values.cols(); ++k)
        add(columns.numbers[static_cast<std::size_t>(k)].name, deviation, columns.values.col(k));
    }
  }

  void add_regions(const LastingAllowance& lasting, const std::vector<std::string>& names) {
    for (std::size_t region = 0; region < names.size(); ++region) {
      VectorXd inside(rows());
      for (Index row = 0; row < rows(); ++row)
        inside(row) = rows_.region[static_cast<std::size_t>(row)] == static_cast<int>(region) ? 1 : 0;
      add(names[region], lasting.of_model(facts_.noise.deviation), inside);
    }
  }

 private:
  Index rows() const { return std::ssize(rows_.series_of); }
  SourceData data() const {
    const VectorXd none = VectorXd::Zero(rows());
    return {rows_.positions, rows_.normals, none, none, none};
  }
  /// Unless it does nothing.
  void add(const std::string& name, double deviation, const VectorXd& values) {
    if (!(deviation > 0) || values.isZero(0)) return;
    const Index q = all_.values.cols();
    all_.values.conservativeResize(Eigen::NoChange, q + 1);
    all_.values.col(q).setZero();
    all_.values.col(q).segment(first_, rows()) = deviation * values;
    all_.errors.push_back({facts_.field(), name, deviation});
  }

  LastingColumns& all_;
  MeasurementFacts facts_;
  const CountedRows& rows_;
  Index first_;
};

}  // namespace

LastingColumns lasting_columns(const Observations& data, const LumenSurface& lumen, const Points& imaged,
                               const LastingAllowance& allowed, double start) {
  std::vector<CountedRows> rows;
  Index count = 0;
  for (const Measurement* source : data.all()) {
    rows.push_back(source->rows(imaged, start));
    count += std::ssize(rows.back().series_of);
  }
  LastingColumns all{{}, MatrixXd(count, 0)};
  Index first = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Measurement& source = *data.all()[i];
    if (rows[i].normals.cols() > 0 && !source.facts().held_out) {
      SourceColumns columns(all, source, rows[i], first);
      columns.add_faults(allowed);
      columns.add_regions(allowed, lumen.region_names);
    }
    first += std::ssize(rows[i].series_of);
  }
  return all;
}

}  // namespace tether
