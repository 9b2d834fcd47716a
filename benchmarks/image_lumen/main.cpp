#include <sys/resource.h>

#include <iostream>

#include "common/base/error.hpp"
#include "tests/image/chest.hpp"
#include "tests/image/true_lumen.hpp"
#include "tests/image/voxelised.hpp"
#include "vessel/image/image_file.hpp"
#include "vessel/image/lumen_of_image.hpp"

/// image_lumen_benchmark voxels [WORD]: how near to the true arch each method comes, by voxel, blur and noise, with
/// times and memory (rows with that word: "level_set | 1 x 2"). chest [WORD]: the level set where bone, lungs, veins
/// and the heart lie beside the lumen. Without anything: both. image_lumen_benchmark IMAGE.mha: writes the scan of
/// configs/aortic_arch_scan.
namespace {

using namespace tether;
using namespace tether::testing;

const Vec3 seed(14.6, 15.2, 30.1);  // in the ascending aorta [cm]

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

LumenImageCase by(ImageMethod method) {
  LumenImageCase how;
  how.seeds = {{"ascending", seed}};
  if (method == ImageMethod::label) how.labels = {"1"};
  if (method == ImageMethod::threshold) how.threshold = ThresholdCase{200, {}};
  if (method == ImageMethod::level_set) how.level_set.emplace();
  return how;
}

/// What was found of an image, and how far it is off, as cells of a table.
std::string found(const Truth& truth, const ImageVolume& image, const LumenImageCase& how) {
  const double begin = cpu_seconds();
  const LumenOfImage lumen = lumen_of(image, how);
  const double taken = cpu_seconds() - begin;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const Off off = testing::off(lumen.surface, truth, image.spacing.minCoeff());
  return fmt::format("{:.3f} | {:.3f} | {:.2f} | {:+.3f} | {:.0f} | {:.1f} | {}", off.mean, off.p95, off.greatest,
                     off.bias, lumen.summary.lumen_volume, taken, used.ru_maxrss / 1024);
}

constexpr const char* found_head = "mean [voxels] | p95 | greatest | bias | cm3 | CPU s | peak MB so far";

void measure(const Truth& truth, ImageMethod method, const Scan& scan, const std::string& word) {
  const std::string row = fmt::format("{} | {:.3g} x {:.3g} mm | {:.2g} | {:.0f}", word_of(method), 10 * scan.voxel,
                                      10 * scan.voxel * scan.shape.z(), scan.blur, scan.noise);
  if (row.find(word) == std::string::npos) return;
  ImageVolume image = scan_of(truth.closed, scan);
  if (method == ImageMethod::label) image = labelled(std::move(image), 200);
  std::cout << fmt::format("| {} | {:.2f} | {} |\n", row, 1e-6 * static_cast<double>(image.values.size()),
                           found(truth, image, by(method)))
            << std::flush;
}

void table(const std::string& word) {
  const Truth truth = arch(TETHER_SOURCE);
  std::cout << "| method | voxel | blur [voxels] | noise | million voxels | " << found_head << " |\n";
  for (const double voxel : {0.2, 0.15, 0.1, 0.075})
    for (const ImageMethod method : {ImageMethod::label, ImageMethod::threshold, ImageMethod::level_set})
      measure(truth, method, {.voxel = voxel}, word);
  for (const ImageMethod method : {ImageMethod::label, ImageMethod::threshold, ImageMethod::level_set}) {
    measure(truth, method, {.voxel = 0.15, .noise = 40}, word);
    measure(truth, method, {.voxel = 0.15, .blur = 1.2}, word);
    measure(truth, method, {.voxel = 0.1, .shape = {1, 1, 2}}, word);
    measure(truth, method, {.voxel = 0.1, .shape = {1, 1, 3}}, word);
  }
}

void measure_row(const Truth& truth, const std::string& what, const Chest& chest, const LumenImageCase& how,
                 double slope) {
  const Scan scan{.voxel = 0.15, .noise = 25};
  ImageVolume image = scan_of(truth.closed, scan, chest);
  for (std::size_t n = 0; n < image.values.size(); ++n)
    image.values[n] *= static_cast<float>(1 + slope * (image.place(n)[2] - 25));
  std::cout << fmt::format("| {} | {} |\n", what, found(truth, image, how)) << std::flush;
}

void chest_table(const std::string& word) {
  const auto measure_in = [&word](const Truth& truth, const std::string& what, const Chest& chest,
                                  const LumenImageCase& how, double slope = 0) {
    if (what.find(word) != std::string::npos) measure_row(truth, what, chest, how, slope);
  };
  const Truth truth = arch(TETHER_SOURCE);
  const LumenImageCase alone = by(ImageMethod::level_set);
  LumenImageCase stopped = alone, told = alone, told_and_stopped = alone;
  stopped.stops = {{"valve", {{15.3, 17.3, 26}, 1.9}}};
  told.neighbours = {{"artery", {17.4, 15, 30}}, {"vein", {12.3, 16, 30}}};
  told_and_stopped.neighbours = {{"artery", {17.4, 15, 30}}, {"vein", {12.3, 16, 30}}, {"spine", {17.5, 25.6, 26}}};
  told_and_stopped.stops = stopped.stops;
  std::vector<Vec3> spots;
  for (int i = 200; i < truth.closed.points.cols(); i += 1500) spots.push_back(truth.closed.points.col(i));
  std::cout << "| level set in a chest | " << found_head << " |\n";
  measure_in(truth, "tissue alone", {}, alone);
  measure_in(truth, "calcified", {.calcifications = spots}, alone);
  measure_in(truth, "lungs", {.lungs = true}, alone);
  measure_in(truth, "spine", {.spine = true}, alone);
  LumenImageCase spine_told = alone;
  spine_told.neighbours = {{"spine", {17.5, 25.6, 26}}};
  measure_in(truth, "spine, named", {.spine = true}, spine_told);
  measure_in(truth, "values fall by 6 % a cm", {}, alone, 0.06);
  for (const double share : {0.6, 0.75, 0.9}) {
    measure_in(truth, fmt::format("vein and artery touch, {}", share), {.vein = share, .artery = share}, alone);
    measure_in(truth, fmt::format("the same, {}, named", share), {.vein = share, .artery = share}, told);
  }
  measure_in(truth, "ventricle", {.ventricle = true}, alone);
  measure_in(truth, "ventricle, a stop at the valve", {.ventricle = true}, stopped);
  const Chest all{
      .vein = 0.75, .artery = 0.75, .lungs = true, .spine = true, .ventricle = true, .calcifications = spots};
  measure_in(truth, "all of it", all, alone);
  measure_in(truth, "all of it, named and stopped", all, told_and_stopped);
}

/// The arch in a box that its branches and the descending aorta leave, between lungs and spine.
void write_example(const std::string& file) {
  const Chest chest{.lungs = true, .spine = true};
  ImageVolume image = scan_of(arch(TETHER_SOURCE).closed, {.voxel = 0.15, .noise = 12, .rim = 1.2}, chest);
  const auto layer = [&](double z) { return static_cast<int>(image.index({0, 0, z})[2]); };
  image = cropped(image, {0, 0, layer(16.6)}, {image.count[0] - 1, image.count[1] - 1, layer(36.1)});
  write_image(file, image, true);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string what = argc > 1 ? argv[1] : "";
  const std::string word = argc > 2 ? argv[2] : "";
  if (what.empty() || what == "voxels") table(word);
  if (what.empty() || what == "chest") chest_table(word);
  if (what.find('.') != std::string::npos) write_example(what);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
