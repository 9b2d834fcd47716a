#include "tests/fuzz/readers.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "common/config/curve_case.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/packet.hpp"
#include "fsi_master/checkpoint.hpp"
#include "identification_master/checkpoint.hpp"
#include "identification_master/results/estimate.hpp"
#include "observation_manager/measurements/contour_file.hpp"
#include "observation_manager/measurements/surface_files.hpp"
#include "observation_manager/measurements/velocity_file.hpp"
#include "solid/case.hpp"
#include "solid/expression.hpp"
#include "tests/fuzz/checksums.hpp"
#include "vessel/anatomy/centreline_file.hpp"
#include "vessel/contours.hpp"
#include "vessel/image/image_file.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/mesh_file.hpp"

namespace tether::fuzz {

namespace {

namespace fs = std::filesystem;

/// Of this process, with what some readers need beside the file that they read.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / fmt::format("tether_fuzz_{}", getpid())) {
    fs::create_directories(path_ / "checkpoint");
    for (const char* name : {"fluid.bin", "solid.bin"})
      write_checked(path_ / "checkpoint" / name, 0, 0, std::array<std::byte, 8>{});
    std::ofstream(path_ / "run.yaml") << "name: run\ntime: {step: 0.1, end: 1}\n";
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const fs::path& folder() {
  static const Folder one;
  return one.path();
}

fs::path written(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Where one input is read in several ways.
template <class Read>
void try_reading(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  }
}

void read_case(const Input& input) {
  CaseFile file(input.file());
  MeshCase mesh;
  SolidCase solid;
  ObservationsCase observations;
  file.read("mesh", mesh);
  file.read("solid", solid);
  file.read("observations", observations);
  file.finish();
}

void read_expression(const Input& input) {
  try {
    Expression(input.bytes, {"x", "y", "k"})({0.5, -2, 0});
  } catch (const RunError&) {  // not finite there
  }
}

void read_mesh(const Input& input) {
  read_mesh_file(input.file());
}

void read_grey(const Input& input) {
  read_image(input.file(), 0.1);
}

void read_slices(const Input& input) {
  SlicesCase given;
  given.file = input.file();
  std::vector<Note> notes;
  read_contour_tracks(given, UnitSystem::cgs(), notes);
}

void read_velocities(const Input& input) {
  VelocitiesCase given;
  given.file = input.file();
  load_velocities("plane", given, CaseFile(folder() / "run.yaml"));
}

void read_curve(const Input& input) {
  CurveCase given(dimension::flow);
  given.file = input.file();
  given.period = 1;
  given.load(UnitSystem::cgs())(0.7);
}

void read_series(const Input& input) {
  SurfacesCase given;
  given.file = input.file();
  files_of(given, UnitSystem::cgs());
}

/// As it is, and what stands behind its header under one that is right: no fuzzer finds a checksum by itself.
template <class Read>
void read_checked_file(const std::string& name, const Input& input, const Read& read) {
  const fs::path file = written(folder() / "checkpoint" / name, input.bytes);
  try_reading(read);
  constexpr std::size_t header = 48;
  write_checked(file, 0, 0, std::as_bytes(std::span(input.bytes).subspan(std::min(header, input.bytes.size()))));
  read();
}

void read_run_checkpoint(const Input& input) {
  read_checked_file("master.bin", input, [] { read_checkpoint(folder()); });
}

void read_checkpoint_of_filter(const Input& input) {
  read_checked_file("identification.bin", input,
                    [] { read_identification_checkpoint(folder(), 0, {}, [](const IdentificationCheckpoint&) {}); });
}

template <class Series>
void read_point_series(const Input& input) {
  const fs::path file = written(folder() / input.name, input.bytes);
  const auto read = [&] { Series{file}.check_has(1); };
  try_reading(read);
  written(file, with_checksums(input.bytes));
  read();
}

/// The first byte says which message it is.
template <class Direction>
void read_message(const Input& input) {
  if (input.bytes.empty()) return;
  const auto* first = reinterpret_cast<const std::byte*>(input.bytes.data());
  protocol::unpack_any<Direction>({std::to_integer<int>(*first), {first + 1, first + input.bytes.size()}});
}

constexpr std::array all{
    FuzzedReader{"case.yaml", read_case},
    FuzzedReader{"expression", read_expression},
    FuzzedReader{"vtu", read_mesh},
    FuzzedReader{"vtp", read_mesh},
    FuzzedReader{"vtk", read_mesh},
    FuzzedReader{"ply", read_mesh},
    FuzzedReader{"stl", read_mesh},
    FuzzedReader{"obj", read_mesh},
    FuzzedReader{"msh", read_mesh},
    FuzzedReader{"mha", read_grey},
    FuzzedReader{"nrrd", read_grey},
    FuzzedReader{"seg.nrrd", [](const Input& input) { read_segments(input.file(), 0.1, {"wall"}, "labels"); }},
    FuzzedReader{"nii", read_grey},
    FuzzedReader{"nii.gz", read_grey},
    FuzzedReader{"sections.csv", [](const Input& input) { read_contours(input.file()); }},
    FuzzedReader{"slices.csv", read_slices},
    FuzzedReader{"velocities.csv", read_velocities},
    FuzzedReader{"curve.csv", read_curve},
    FuzzedReader{"centreline.csv", [](const Input& input) { read_centreline(input.file(), UnitSystem::cgs()); }},
    FuzzedReader{"series.csv", read_series},
    FuzzedReader{"pvd", read_series},
    FuzzedReader{"estimate.json", [](const Input& input) { read_record<Estimate>(input.file()); }},
    FuzzedReader{"master.bin", read_run_checkpoint},
    FuzzedReader{"identification.bin", read_checkpoint_of_filter},
    FuzzedReader{"lumen.motion", read_point_series<LumenMotion>},
    FuzzedReader{"blood.velocity", read_point_series<BloodVelocity>},
    FuzzedReader{"to_partner", read_message<protocol::ToPartner>},
    FuzzedReader{"to_master", read_message<protocol::ToMaster>},
};

}  // namespace

fs::path Input::file() const {
  return written(folder() / fmt::format("input.{}", name), bytes);
}

std::span<const FuzzedReader> readers() {
  return all;
}

void read_any(const FuzzedReader& reader, const std::string& bytes) {
  try {
    try_reading([&] { reader.read({reader.name, bytes}); });
  } catch (const protocol::MalformedMessage&) {
  }
}

}  // namespace tether::fuzz
