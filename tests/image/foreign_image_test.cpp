/// Files as 3D Slicer and ITK-SNAP write them: one voxel that differs, and where in the patient it is.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/image/image_file.hpp"
#include "vessel/image/open_image.hpp"

namespace tether {
namespace foreign_image_test {

namespace fs = std::filesystem;

constexpr int nx = 4, ny = 5, nz = 6, voxels = nx * ny * nz;
constexpr int marked = 1 + nx * (2 + ny * 3);  // voxel 1 2 3

std::string bytes_with(unsigned char value) {
  std::string bytes(voxels, '\0');
  bytes[marked] = static_cast<char>(value);
  return bytes;
}

/// The place of the one voxel that is not zero [cm].
Vec3 place_of_mark(const ImageVolume& image) {
  const auto mark = std::max_element(image.values.begin(), image.values.end());
  EXPECT_EQ(std::count(image.values.begin(), image.values.end(), 0.0F), voxels - 1);
  return image.place(static_cast<std::size_t>(mark - image.values.begin()));
}

/// A .nii of uint8: 2 x 3 x 4 mm voxels from (10, 20, 30) mm in RAS, turned by 90 degrees about z: the image's first
/// axis points to the front, its second to the left.
struct Nifti {
  bool sform = true, qform = true;
  float slope = 0;
  std::string bytes() const {
    std::string header(352, '\0');
    const auto put = [&](std::size_t at, auto value) { std::memcpy(header.data() + at, &value, sizeof(value)); };
    put(0, std::int32_t{348});
    for (const auto& [i, n] : {std::pair{0, 3}, {1, nx}, {2, ny}, {3, nz}, {4, 1}, {5, 1}, {6, 1}, {7, 1}})
      put(40 + 2 * static_cast<std::size_t>(i), static_cast<std::int16_t>(n));
    put(70, std::int16_t{2}), put(72, std::int16_t{8});  // uint8, bits
    for (const auto& [i, size] : {std::pair{0, 1.F}, {1, 2.F}, {2, 3.F}, {3, 4.F}})
      put(76 + 4 * static_cast<std::size_t>(i), size);
    put(108, 352.F), put(112, slope), put(123, std::uint8_t{2});  // mm
    put(252, static_cast<std::int16_t>(qform)), put(254, static_cast<std::int16_t>(sform));
    put(256, 0.F), put(260, 0.F), put(264, std::sqrt(0.5F));  // a quarter turn about z
    put(268, 10.F), put(272, 20.F), put(276, 30.F);
    put(280, std::array<float, 12>{0, -3, 0, 10, 2, 0, 0, 20, 0, 0, 4, 30});
    std::memcpy(header.data() + 344, "n+1", 4);
    return header + bytes_with(3);
  }
};
const Vec3 nifti_ras(1.0 - 0.3 * 2, 2.0 + 0.2 * 1, 3.0 + 0.4 * 3);  // voxel 1 2 3 [cm]
const Vec3 nifti_lps(-nifti_ras[0], -nifti_ras[1], nifti_ras[2]);

TEST(ForeignImage, ANiftiIsReadByItsSformOrQform) {
  const TemporaryFolder folder;
  for (const Nifti& nifti : {Nifti{true, true}, Nifti{true, false}, Nifti{false, true}}) {
    const ImageVolume image = read_image(folder.file("snap.nii", nifti.bytes()), 0.1);
    EXPECT_LT((place_of_mark(image) - nifti_lps).norm(), 1e-6) << nifti.sform << nifti.qform;
    EXPECT_LT((image.spacing - Vec3(0.2, 0.3, 0.4)).norm(), 1e-6);
  }
}

TEST(ForeignImage, ItsValuesAreScaled) {
  const TemporaryFolder folder;
  const ImageVolume image = read_image(folder.file("scaled.nii", Nifti{true, true, 100}.bytes()), 0.1);
  EXPECT_EQ(*std::max_element(image.values.begin(), image.values.end()), 300);
}

TEST(ForeignImage, CoordinatesMayBeThoseThatSlicerShows) {
  const TemporaryFolder folder;
  LumenImageCase how;
  how.file = folder.file("snap.nii", Nifti{}.bytes());
  how.labels = {"3"}, how.space = "ras";
  const ImageVolume image = open_image(how);
  EXPECT_LT((place_of_mark(image) - nifti_ras).norm(), 1e-6);
  EXPECT_NEAR(image.axes.determinant(), 1, 1e-6);
}

std::string nrrd(const std::string& space, const std::string& directions) {
  return "NRRD0004\ntype: uint8\ndimension: 3\nspace: " + space + "\nsizes: 4 5 6\nspace directions: " + directions +
         "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (10,20,30)\n\n" + bytes_with(3);
}

TEST(ForeignImage, ANrrdIsReadByItsSpace) {
  const TemporaryFolder folder;
  const std::string along = "(2,0,0) (0,3,0) (0,0,4)";
  const Vec3 here(1.2, 2.6, 4.2);
  const auto place = [&](const std::string& space) {
    return place_of_mark(read_image(folder.file("slicer.nrrd", nrrd(space, along)), 0.1));
  };
  EXPECT_LT((place("left-posterior-superior") - here).norm(), 1e-6);
  EXPECT_LT((place("right-anterior-superior") - Vec3(-here[0], -here[1], here[2])).norm(), 1e-6);
  EXPECT_NE(message_of([&] { place("left-anterior-superior"); }).find("its space is left-anterior-superior"),
            std::string::npos);
}

/// As 3D Slicer saves segments that overlap: the first axis is the layer.
std::string segments(int layers) {
  std::string data;
  for (int n = 0; n < voxels; ++n)
    for (int layer = 0; layer < layers; ++layer) data += static_cast<char>(n == marked + layer ? 2 : 0);
  const std::string list = layers > 1 ? "none " : "", kind = layers > 1 ? "list " : "";
  std::string text = "NRRD0005\ntype: unsigned char\ndimension: " + std::to_string(layers > 1 ? 4 : 3) +
                     "\nspace: left-posterior-superior\nsizes: " + (layers > 1 ? std::to_string(layers) + " " : "") +
                     "4 5 6\nspace directions: " + list + "(2,0,0) (0,3,0) (0,0,4)\nkinds: " + kind +
                     "domain domain domain\nencoding: raw\nspace origin: (10,20,30)\n";
  for (int i = 0; i < 2; ++i)
    text += fmt::format(
        "Segment{0}_ID:=Segment_{0}\nSegment{0}_Name:={1}\nSegment{0}_LabelValue:=2\nSegment{0}_Layer:={2}\n", i,
        i == 0 ? "aorta" : "left carotid", layers > 1 ? i : 0);
  return text + "\n" + data;
}

TEST(ForeignImage, SegmentsAreFoundByName) {
  const TemporaryFolder folder;
  LumenImageCase how;
  for (const int layers : {1, 2}) {
    how.file = folder.file("slicer.seg.nrrd", segments(layers));
    how.labels = {"aorta"};
    EXPECT_LT((place_of_mark(open_image(how)) - Vec3(1.2, 2.6, 4.2)).norm(), 1e-6);
  }
  how.labels = {"left carotid"};
  EXPECT_LT((place_of_mark(open_image(how)) - Vec3(1.4, 2.6, 4.2)).norm(), 1e-6);
  how.labels = {"aorta", "left carotid"};
  const ImageVolume both = open_image(how);
  EXPECT_EQ(std::count(both.values.begin(), both.values.end(), 1.0F), 2);
  how.labels = {"aotra"};
  EXPECT_NE(message_of([&] { open_image(how); }).find("aotra: is not a segment of"), std::string::npos);
  EXPECT_NE(message_of([&] { open_image(how); }).find("which has aorta, left carotid"), std::string::npos);
  how.labels = {"2"};
  EXPECT_NE(message_of([&] { open_image(how); }).find("say by name which are meant, labels: [aorta, left carotid]"),
            std::string::npos)
      << message_of([&] { open_image(how); });
}

TEST(ForeignImage, ACropKeepsWhereThingsAre) {
  const TemporaryFolder folder;
  LumenImageCase how;
  how.file = folder.file("snap.nii", Nifti{}.bytes());
  how.threshold.emplace().above = 1;
  const ImageVolume whole = open_image(how);
  how.crop = {nifti_lps - Vec3(0.5, 0.3, 0.7), nifti_lps + Vec3(0.5, 0.3, 0.7)};
  const ImageVolume part = open_image(how);
  EXPECT_LT(part.values.size(), whole.values.size());
  EXPECT_LT((part.place(static_cast<std::size_t>(std::max_element(part.values.begin(), part.values.end()) -
                                                 part.values.begin())) -
             nifti_lps)
                .norm(),
            1e-6);
  how.crop = {Vec3(40, 40, 40), Vec3(50, 50, 50)};
  EXPECT_NE(message_of([&] { open_image(how); }).find("image.crop: leaves less than three voxels"), std::string::npos);
}

}  // namespace foreign_image_test
}  // namespace tether
