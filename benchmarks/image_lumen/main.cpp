#include <sys/resource.h>

#include <iostream>

#include "common/base/error.hpp"
#include "tests/image/true_lumen.hpp"
#include "tests/image/voxelised.hpp"
#include "vessel/image/image_file.hpp"
#include "vessel/image/lumen_of_image.hpp"

/// image_lumen_benchmark: how near to the true arch each method comes, by voxel, blur and noise, with times and memory.
/// image_lumen_benchmark IMAGE.mha: the scan of configs/aortic_arch_scan.
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
  if (method == ImageMethod::label) how.label = 1;
  if (method == ImageMethod::threshold) how.threshold = ThresholdCase{200, {}};
  if (method == ImageMethod::level_set) how.level_set.emplace();
  return how;
}

void measure(const Truth& truth, ImageMethod method, const Scan& scan) {
  ImageVolume image = scan_of(truth.closed, scan);
  if (method == ImageMethod::label) image = labelled(std::move(image), 200);
  const double begin = cpu_seconds();
  const LumenOfImage lumen = lumen_of(image, by(method));
  const double taken = cpu_seconds() - begin;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const Off off = testing::off(lumen.surface, truth, scan.voxel);
  std::cout << fmt::format(
                   "| {} | {:.3g} x {:.3g} mm | {:.2g} | {:.0f} | {:.2f} | {:.3f} | {:.3f} | {:.2f} | {:+.3f} | {:.1f} "
                   "| {} |\n",
                   word_of(method), 10 * scan.voxel, 10 * scan.voxel * scan.shape.z(), scan.blur, scan.noise,
                   1e-6 * static_cast<double>(image.values.size()), off.mean, off.p95, off.greatest, off.bias, taken,
                   used.ru_maxrss / 1024)
            << std::flush;
}

void table() {
  const Truth truth = arch(TETHER_SOURCE);
  std::cout << "| method | voxel | blur [voxels] | noise | million voxels | mean [voxels] | p95 | greatest | bias | "
               "CPU s | peak MB so far |\n";
  for (const double voxel : {0.2, 0.15, 0.1, 0.075})
    for (const ImageMethod method : {ImageMethod::label, ImageMethod::threshold, ImageMethod::level_set})
      measure(truth, method, {.voxel = voxel});
  for (const ImageMethod method : {ImageMethod::label, ImageMethod::threshold, ImageMethod::level_set}) {
    measure(truth, method, {.voxel = 0.15, .noise = 40});
    measure(truth, method, {.voxel = 0.15, .blur = 1.2});
    measure(truth, method, {.voxel = 0.1, .shape = {1, 1, 2}});
  }
}

/// The arch in a box that its branches and the descending aorta leave, with a bright spine behind it.
void write_example(const std::string& file) {
  ImageVolume image = scan_of(arch(TETHER_SOURCE).closed, {.voxel = 0.15, .noise = 0, .rim = 1.2});
  const auto layer = [&](double z) { return static_cast<int>(image.index({0, 0, z})[2]); };
  image = cropped(image, {0, 0, layer(16.6)}, {image.count[0] - 1, image.count[1] - 1, layer(36.1)});
  Random random(2, 0);
  for (std::size_t n = 0; n < image.values.size(); ++n) {
    const Vec3 x = image.place(n);
    const double spine = 1 / (1 + std::exp((std::hypot(x[0] - 15, x[1] - 25.5) - 1.5) / 0.06));
    image.values[n] += static_cast<float>(400 * spine + 12 * random.normal());
  }
  write_image(file, image, true);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc > 1)
    write_example(argv[1]);
  else
    table();
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
