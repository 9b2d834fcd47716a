#include "identification_master/checkpoint.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "common/base/checked_file.hpp"
#include "common/base/newest_state.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/protocol/packet.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

struct PackedMatrix {
  std::int64_t rows = 0;
  std::vector<double> values;
  PackedMatrix() = default;
  explicit PackedMatrix(const auto& m) : rows(m.rows()), values(m.data(), m.data() + m.size()) {}
  MatrixXd matrix() const {
    const auto size = static_cast<std::int64_t>(values.size());
    if (rows < 0 || (rows == 0 ? size : size % rows) != 0) refuse();
    return Eigen::Map<const MatrixXd>(values.data(), rows, rows == 0 ? 0 : size / rows);
  }
  VectorXd vector() const {
    if (rows != static_cast<std::int64_t>(values.size())) refuse();
    return Eigen::Map<const VectorXd>(values.data(), rows);
  }
  [[noreturn]] void refuse() const {
    throw protocol::MalformedMessage(fmt::format("a matrix of {} rows has {} values", rows, values.size()));
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

/// The numbers of a record in their order.
template <class Record>
std::vector<double> packed_numbers(const Record& record) {
  std::vector<double> all;
  Record::numbers(record, [&](const auto& number) { all.push_back(static_cast<double>(number)); });
  return all;
}

PackedRecord packed(const EstimateRecord& r) {
  return {packed_numbers(r), PackedMatrix(r.mean), PackedMatrix(r.covariance)};
}

void require_size(const std::vector<double>& numbers, std::size_t size) {
  if (numbers.size() != size)
    throw protocol::MalformedMessage(fmt::format("{} numbers stand where {} should", numbers.size(), size));
}

int whole(double number) {
  if (!(std::abs(number) <= std::numeric_limits<int>::max()))
    throw protocol::MalformedMessage(fmt::format("{} stands where a count should", number));
  return static_cast<int>(number);
}

/// Takes them back.
template <class Record>
void take_numbers(const std::vector<double>& packed, Record& record) {
  require_size(packed, packed_numbers(record).size());
  auto next = packed.begin();
  Record::numbers(record, [&]<class Number>(Number& number) {
    if constexpr (std::is_same_v<Number, int>)
      number = whole(*next++);
    else
      number = *next++;
  });
}

EstimateRecord unpacked(const PackedRecord& p) {
  EstimateRecord record;
  take_numbers(p.numbers, record);
  record.mean = p.mean.vector();
  record.covariance = p.covariance.matrix();
  return record;
}

fs::path newest_in(const fs::path& folder) {
  return folder / "identification.bin";
}
fs::path before_in(const fs::path& folder) {
  return folder / "identification.previous";
}
/// Not put in its place yet; whole if the identification was killed just then.
fs::path fresh_in(const fs::path& folder) {
  return folder / "identification.new";
}

IdentificationCheckpoint unpacked(const CheckedContent& content) {
  IdentificationCheckpoint checkpoint;
  IdentificationState& state = checkpoint.state;
  state.step = content.step;
  PackedMatrix theta, states, last_mean, lasting_mean, lasting_slope, lasting_covariance, information;
  PackedRecord last;
  std::vector<double> totals, innovations, cost;
  std::int64_t table = 0;
  protocol::Reader reader("checkpoint", content.bytes);
  reader(theta, states, state.memories, checkpoint.at_hand, last, totals, table, innovations, last_mean, lasting_mean,
         lasting_slope, lasting_covariance, information, cost);
  reader.expect_end();
  require_size(innovations, 3), require_size(cost, 4);
  state.theta = theta.matrix();
  state.states = states.matrix();
  state.last_mean = last_mean.vector();
  state.lasting = {lasting_mean.vector(), lasting_slope.matrix(), lasting_covariance.matrix()};
  state.information = information.matrix();
  checkpoint.table = static_cast<std::uint64_t>(table);
  state.last = unpacked(last);
  take_numbers(totals, state.totals);
  state.innovations = {innovations[0], innovations[1], innovations[2]};
  checkpoint.cost = {cost[0], cost[1], cost[2], whole(cost[3])};
  return checkpoint;
}

/// Throws InputError if it is damaged.
std::pair<std::uint64_t, IdentificationCheckpoint> read_file(const fs::path& path) {
  const CheckedContent content = read_checked(path);
  try {
    return {content.fingerprint, unpacked(content)};
  } catch (const protocol::MalformedMessage& error) {
    throw input_error("{}: {}", path.string(), error.what());
  }
}

struct Found {
  fs::path file;
  std::uint64_t of_case = 0;
  IdentificationCheckpoint checkpoint;
};

/// The newest that is whole and that `take_up` does not refuse.
Found newest_whole_in(const fs::path& folder, const std::function<void(const Found&)>& take_up) {
  std::string damage;
  for (const fs::path& file : {fresh_in(folder), newest_in(folder), before_in(folder)}) {
    if (!fs::exists(file)) continue;
    try {
      auto [of_case, checkpoint] = read_file(file);
      Found found{file, of_case, std::move(checkpoint)};
      take_up(found);
      found.checkpoint.refused = damage;
      return found;
    } catch (const InputError& error) {
      if (file != fresh_in(folder) && damage.empty()) damage = error.what();
    }
  }
  if (damage.empty())
    throw input_error("{}: holds no checkpoint of an identification to resume from", folder.parent_path().string());
  throw input_error("{}; there is none before it to go on from: start anew without --resume", damage);
}

bool is_whole(const fs::path& file) {
  try {
    read_file(file);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

void put_fresh_in_place(const fs::path& folder) {
  if (const fs::path newest = newest_in(folder); fs::exists(newest)) put_in_place(newest, before_in(folder));
  put_in_place(fresh_in(folder), newest_in(folder));
}

}  // namespace

/// A run in the same folder that was killed may have left them where it lent them to.
void remove_identification_checkpoints(const fs::path& output) {
  for (const char* folder : {newest_checkpoint, fresh_checkpoint, earlier_checkpoint})
    for (const char* file : identification_state_files) fs::remove(output / folder / file);
}

void write_checkpoint(const fs::path& output, std::uint64_t fingerprint, const IdentificationCheckpoint& checkpoint) {
  const auto& [state, at_hand, cost, table, refused] = checkpoint;
  protocol::Writer writer;
  writer(PackedMatrix(state.theta), PackedMatrix(state.states), state.memories, at_hand, packed(state.last),
         packed_numbers(state.totals), static_cast<std::int64_t>(table),
         std::vector<double>{state.innovations.products, state.innovations.squares, state.innovations.squares_before},
         PackedMatrix(state.last_mean), PackedMatrix(state.lasting.mean), PackedMatrix(state.lasting.slope),
         PackedMatrix(state.lasting.covariance), PackedMatrix(state.information),
         std::vector<double>{cost.wall_seconds, cost.cpu_seconds, cost.master_cpu_seconds,
                             static_cast<double>(cost.moved_values)});
  const fs::path folder = output / "checkpoint";
  make_folder(folder);
  if (is_whole(fresh_in(folder))) put_fresh_in_place(folder);  // it may be the only one that is
  write_checked(fresh_in(folder), fingerprint, state.step, writer.take());
  put_fresh_in_place(folder);
  flush_to_disk(folder);
}

std::size_t groups_of_checkpoint(const fs::path& output) {
  return newest_whole_in(output / "checkpoint", [](const Found&) {}).checkpoint.at_hand.size();
}

/// Of which case it is comes before what lies beside it.
IdentificationCheckpoint read_identification_checkpoint(
    const fs::path& output, std::uint64_t fingerprint, const std::string& changes,
    const std::function<void(const IdentificationCheckpoint&)>& take_up) {
  const fs::path folder = output / "checkpoint";
  Found newest = newest_whole_in(folder, [&](const Found& found) {
    if (found.of_case == fingerprint) take_up(found.checkpoint);
  });
  if (newest.of_case != fingerprint)
    throw input_error("{}: is a checkpoint of another case{}; give the case as it was, or start anew without --resume",
                      newest.file.string(), changes.empty() ? "" : " (" + changes + ")");
  return std::move(newest.checkpoint);
}

}  // namespace tether
