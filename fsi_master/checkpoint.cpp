#include "fsi_master/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>

#include "common/protocol/packet.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using protocol::Bytes;

/// At the beginning of each file; all members are 8 bytes.
struct Header {
  std::array<char, 8> magic{'T', 'E', 'T', 'H', 'E', 'R', 'C', 'P'};
  std::uint64_t version = 2;
  std::uint64_t fingerprint = 0;
  std::int64_t step = 0;
  std::uint64_t size = 0, checksum = 0;  ///< of the bytes that follow
};

/// Gives a file or folder to the disk before it is renamed.
void flush_to_disk(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY);
  const bool flushed = descriptor >= 0 && fsync(descriptor) == 0;
  if (descriptor >= 0) close(descriptor);
  if (!flushed) throw run_error("{}: cannot be written to the disk: {}", path.string(), std::strerror(errno));
}

void write_file(const fs::path& path, const Checkpoint& checkpoint, const Bytes& bytes) {
  const Header header{.fingerprint = checkpoint.fingerprint,
                      .step = checkpoint.step,
                      .size = bytes.size(),
                      .checksum = hash_bytes(bytes.data(), bytes.size())};
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(&header), sizeof header);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw run_error("{}: cannot be written (disk full?)", path.string());
  flush_to_disk(path);
}

struct FileContent {
  Header header;
  Bytes bytes;
};

FileContent read_file(const fs::path& path) {
  FileContent content;
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(&content.header), sizeof content.header);
  if (!file || content.header.magic != Header{}.magic)
    throw input_error("{}: is no file of a checkpoint", path.string());
  if (content.header.version != Header{}.version)
    throw input_error("{}: was written by another version of Tether", path.string());
  if (fs::file_size(path) != sizeof(Header) + content.header.size) throw input_error("{}: is cut short", path.string());
  content.bytes.resize(content.header.size);
  file.read(reinterpret_cast<char*>(content.bytes.data()), static_cast<std::streamsize>(content.bytes.size()));
  if (!file || hash_bytes(content.bytes.data(), content.bytes.size()) != content.header.checksum)
    throw input_error("{}: is damaged (checksum)", path.string());
  return content;
}

template <class... Fields>
Bytes packed(const Fields&... fields) {
  protocol::Writer writer;
  writer(fields...);
  return writer.take();
}

template <class... Fields>
void unpack(const FileContent& content, Fields&... fields) {
  protocol::Reader reader("checkpoint", content.bytes);
  reader(fields...);
  reader.expect_end();
}

Checkpoint read_folder(const fs::path& folder) {
  Checkpoint c;
  const FileContent master = read_file(folder / "master.bin");
  c.step = master.header.step;
  c.fingerprint = master.header.fingerprint;
  std::vector<double> numbers;
  unpack(master, c.snapshot.displacement, c.snapshot.velocity, c.snapshot.method, c.snapshot.coupling, numbers,
         c.without_state);
  auto next = numbers.begin();
  c.statistics.numbers([&](double& value) { value = next != numbers.end() ? *next++ : 0.0; });
  for (const auto& [name, state] :
       {std::pair("fluid.bin", &c.snapshot.fluid), std::pair("solid.bin", &c.snapshot.solid)}) {
    const FileContent content = read_file(folder / name);
    if (content.header.step != c.step)
      throw input_error("{}: is of another step than master.bin", (folder / name).string());
    unpack(content, *state);
  }
  return c;
}

}  // namespace

void write_checkpoint(const fs::path& output, const Checkpoint& checkpoint) {
  const fs::path current = output / "checkpoint", fresh = output / "checkpoint.new",
                 previous = output / "checkpoint.previous";
  std::vector<double> numbers;
  RunStatistics statistics = checkpoint.statistics;
  statistics.numbers([&](double& value) { numbers.push_back(value); });
  const Snapshot& s = checkpoint.snapshot;
  fs::remove_all(fresh);
  fs::create_directories(fresh);
  write_file(fresh / "master.bin", checkpoint,
             packed(s.displacement, s.velocity, s.method, s.coupling, numbers, checkpoint.without_state));
  write_file(fresh / "fluid.bin", checkpoint, packed(s.fluid));
  write_file(fresh / "solid.bin", checkpoint, packed(s.solid));
  flush_to_disk(fresh);
  fs::remove_all(previous);
  if (fs::exists(current)) fs::rename(current, previous);
  fs::rename(fresh, current);
  flush_to_disk(output);
}

Checkpoint read_checkpoint(const fs::path& output, std::uint64_t fingerprint) {
  fs::path folder = output / "checkpoint";
  if (!fs::exists(folder)) folder = output / "checkpoint.previous";  // stopped between the two renames
  if (!fs::exists(folder)) throw input_error("{}: holds no checkpoint to resume from", output.string());
  Checkpoint checkpoint = read_folder(folder);
  if (checkpoint.fingerprint != fingerprint)
    throw input_error(
        "{}: is a checkpoint of another case or mesh; give the case as it was, or start anew without --resume",
        folder.string());
  if (!checkpoint.without_state.empty())
    throw input_error("{}: cannot be continued: {} announced no state to be saved", folder.string(),
                      checkpoint.without_state);
  return checkpoint;
}

std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t hash = seed;
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min<std::size_t>(8, size - i));
    hash = (hash ^ word) * 1099511628211ull;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace tether
