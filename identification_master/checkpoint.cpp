#include "identification_master/checkpoint.hpp"

#include "common/base/checked_file.hpp"
#include "common/protocol/packet.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

struct PackedMatrix {
  std::int64_t rows = 0;
  std::vector<double> values;
  PackedMatrix() = default;
  explicit PackedMatrix(const MatrixXd& m) : rows(m.rows()), values(m.data(), m.data() + m.size()) {}
  MatrixXd matrix() const {
    const Eigen::Index columns = rows > 0 ? static_cast<Eigen::Index>(values.size()) / rows : 0;
    return Eigen::Map<const MatrixXd>(values.data(), rows, columns);
  }
  template <class Archive>
  void fields(Archive& archive) {
    archive(rows, values);
  }
  template <class Archive>
  void fields(Archive& archive) const {
    archive(rows, values);
  }
};

struct PackedRecord {
  std::vector<double> numbers;
  PackedMatrix mean, covariance;
  template <class Archive>
  void fields(Archive& archive) {
    archive(numbers, mean, covariance);
  }
  template <class Archive>
  void fields(Archive& archive) const {
    archive(numbers, mean, covariance);
  }
};

PackedRecord packed(const EstimateRecord& r) {
  return {{r.time, r.data, r.chi_square, r.rejected, r.tempering, r.evaluations},
          PackedMatrix(r.mean),
          PackedMatrix(r.covariance)};
}

EstimateRecord unpacked(const PackedRecord& p) {
  if (p.numbers.size() != 6) throw input_error("a record of the checkpoint has {} numbers", p.numbers.size());
  return {p.numbers[0], p.mean.matrix(), p.covariance.matrix(), p.numbers[1],
          p.numbers[2], p.numbers[3],    p.numbers[4],          p.numbers[5]};
}

}  // namespace

void write_checkpoint(const fs::path& output, std::uint64_t fingerprint, const IdentificationState& state) {
  std::vector<PackedRecord> records;
  for (const EstimateRecord& record : state.records) records.push_back(packed(record));
  protocol::Writer writer;
  writer(PackedMatrix(state.theta), PackedMatrix(state.states), state.memories, records,
         std::vector<double>{state.innovations.products, state.innovations.squares}, PackedMatrix(state.last_mean));
  const fs::path folder = output / "checkpoint", fresh = folder / "identification.new";
  fs::create_directories(folder);
  write_checked(fresh, fingerprint, state.step, writer.take());
  fs::rename(fresh, folder / "identification.bin");
  flush_to_disk(folder);
}

IdentificationState read_checkpoint(const fs::path& output, std::uint64_t fingerprint) {
  const fs::path path = output / "checkpoint" / "identification.bin";
  if (!fs::exists(path))
    throw input_error("{}: holds no checkpoint of an identification to resume from", output.string());
  const CheckedContent content = read_checked(path);
  if (content.fingerprint != fingerprint)
    throw input_error("{}: is a checkpoint of another case; give the case as it was, or start anew without --resume",
                      path.string());
  IdentificationState state;
  state.step = content.step;
  PackedMatrix theta, states, last_mean;
  std::vector<PackedRecord> records;
  std::vector<double> innovations;
  protocol::Reader reader("checkpoint", content.bytes);
  reader(theta, states, state.memories, records, innovations, last_mean);
  reader.expect_end();
  state.theta = theta.matrix();
  state.states = states.matrix();
  state.last_mean = last_mean.matrix();
  for (const PackedRecord& record : records) state.records.push_back(unpacked(record));
  state.innovations = {innovations.at(0), innovations.at(1)};
  return state;
}

}  // namespace tether
