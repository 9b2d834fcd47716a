#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <sstream>

#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/image/image_file.hpp"
#include "vessel/study/build_surface.hpp"

/// Images and studies that are wrong in one way each: one message with the study's line or the file; or taken all the
/// same.
namespace tether {
namespace {

namespace fs = std::filesystem;
using namespace testing;

/// The bent tube in a box of 1.5 mm voxels that its ends leave: grey values fall from 350 to 50 about the wall.
ImageVolume tube_image(const Vec3& spacing = Vec3::Constant(0.15), const Mat3& axes = Mat3::Identity()) {
  const Vec3 low(-2, 0, -1.5), high(5.5, 5.5, 1.5);
  ImageVolume image{"tube", {}, axes * low, spacing, axes, {}};
  for (int axis = 0; axis < 3; ++axis)
    image.count[static_cast<std::size_t>(axis)] = static_cast<int>((high - low)[axis] / spacing[axis]) + 1;
  for (int k = 0; k < image.count[2]; ++k)
    for (int j = 0; j < image.count[1]; ++j)
      for (int i = 0; i < image.count[0]; ++i) {
        const Vec3 x = axes.transpose() * image.place(Vec3(i, j, k));
        const double off = std::hypot(x.head<2>().norm() - bend_radius, x.z()) - tube_radius;
        image.values.push_back(static_cast<float>(50 + 300 / (1 + std::exp(off / 0.05))));
      }
  return image;
}

struct Folder {
  const fs::path path = test_folder();
  /// A study of an image; line 2 is the section `image`.
  StudyCase study(const std::string& image, const std::string& in = "[4, 0, 0]",
                  const std::string& out = "[-2, 3.46, 0]") const {
    std::ofstream(path / "study.yaml") << "name: tube\nimage: {" << image << "}\nopenings:\n  in: {near: " << in
                                       << "}\n  out: {near: " << out << "}\ninlet: in\nedges: {longest: 3 mm}\n";
    return read_study(path / "study.yaml");
  }
  std::string refusal(const std::string& image) const {
    try {
      build_surface(study(image));
    } catch (const InputError& error) {
      return error.what();
    }
    return "was not refused";
  }
  void text(const std::string& file, const std::string& header, const std::string& data = "") const {
    std::ofstream(path / file, std::ios::binary) << "ObjectType = Image\n"
                                                 << header << "ElementDataFile = LOCAL\n"
                                                 << data;
  }
};

void expect_said(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
}

struct Wrong {
  const char* name;
  const char* image;  ///< the section of the study, of the tube's image
  std::vector<const char*> said;
};
class WrongStudy : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongStudy, IsToldInOneMessageWithItsLine) {
  const Folder folder;
  write_image(folder.path / "grey.mha", tube_image());
  ImageVolume labels = tube_image();
  for (float& value : labels.values) value = value > 200 ? 3 : value > 60 ? 7 : 0;
  write_image(folder.path / "labels.nii.gz", labels, true);
  std::fill(labels.values.begin(), labels.values.end(), 0.0F);
  write_image(folder.path / "empty.nrrd", labels, true);
  const std::string message = folder.refusal(GetParam().image);
  for (const char* part : GetParam().said)
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
}

const Wrong wrong[] = {
    {"empty_label_map", "file: empty.nrrd, labels: [1]", {"study.yaml:2: image.labels", "empty.nrrd is empty"}},
    {"label_that_is_not_there",
     "file: labels.nii.gz, labels: [4]",
     {"study.yaml:2: image.labels: 4", "which has 3, 7"}},
    {"grey_values_as_labels", "file: grey.mha, labels: [1]", {"study.yaml:2: image.labels", "is no label map"}},
    {"threshold_above_all",
     "file: grey.mha, threshold: {above: 900}",
     {"study.yaml:2: image.threshold.above: 900: nothing", "from 50 to 350"}},
    {"threshold_below_all",
     "file: grey.mha, threshold: {above: 10}",
     {"study.yaml:2: image.threshold.above: 10: all", "from 50 to 350"}},
    {"upper_threshold_below_all",
     "file: grey.mha, threshold: {below: 10}",
     {"study.yaml:2: image.threshold.below: 10: nothing"}},
    {"seed_outside_the_image",
     "file: grey.mha, threshold: {above: 200}, seeds: {a: [40, 0, 0]}",
     {"study.yaml:2: image.seeds.a", "(40, 0, 0) cm lies outside", "reaches from (-2.075, -0.075, -1.575)"}},
    {"seed_in_the_background",
     "file: grey.mha, threshold: {above: 200}, seeds: {a: [0, 0, 0]}",
     {"study.yaml:2: image.seeds.a", "outside the lumen", "value 50"}},
    {"no_method", "file: grey.mha", {"study.yaml:2: image", "or threshold or level_set must be given"}},
    {"two_methods", "file: grey.mha, labels: [1], threshold: {above: 3}", {"study.yaml:2: image", "one of the others"}},
    {"inverted_threshold",
     "file: grey.mha, threshold: {above: 300, below: 100}",
     {"study.yaml:2: image.threshold.above", "must be less than below"}},
    {"seed_in_ras",
     "file: grey.mha, threshold: {above: 200}, seeds: {a: [-3, -3, 0]}",
     {"study.yaml:2: image.seeds.a", "image.space: ras"}},
    {"seed_in_mm", "file: grey.mha, threshold: {above: 200}, seeds: {a: [40, 0, 0]}", {"is it in mm?"}},
    {"seeds_in_lumen_and_tissue",
     "file: grey.mha, level_set: {}, seeds: {a: [4, 0.3, 0], b: [0, 0.3, 0]}",
     {"study.yaml:2: image.seeds", "50 at one, 350 at another"}},
    {"seed_in_a_stop",
     "file: grey.mha, threshold: {above: 200}, seeds: {a: [2, 3.46, 0]}, stops: {s: {point: [2, 3.5, 0], radius: 3 "
     "mm}}",
     {"study.yaml:2: image.seeds.a", "outside the lumen"}},
    {"neighbour_outside_the_image",
     "file: grey.mha, level_set: {}, seeds: {a: [2, 3.46, 0]}, neighbours: {vein: [0, 0, 9]}",
     {"study.yaml:2: image.neighbours.vein", "lies outside"}},
    {"neighbours_of_a_threshold",
     "file: grey.mha, threshold: {above: 200}, neighbours: {vein: [0, 0, 0]}",
     {"image.neighbours: are for a level_set"}},
    {"crop_beside_the_image",
     "file: grey.mha, threshold: {above: 200}, crop: {low: [20, 0, 0], high: [30, 5, 1]}",
     {"study.yaml:2: image.crop", "reaches from (-2.075, -0.075, -1.575)"}},
    {"crop_upside_down",
     "file: grey.mha, threshold: {above: 200}, crop: {low: [3, 0, 0], high: [1, 5, 1]}",
     {"image.crop.low: must be below high"}},
    {"no_file", "file: lost.mha, threshold: {above: 200}", {"study.yaml:2: image.file"}},
    {"level_set_without_seeds", "file: grey.mha, level_set: {}", {"image.seeds: must be given with a level_set"}},
    {"level_set_in_an_even_image",
     "file: empty.nrrd, level_set: {}, seeds: {a: [4, 0.1, 0]}",
     {"study.yaml:2: image.level_set", "does not change around the seeds"}},
    {"threshold_of_nothing", "file: grey.mha, threshold: {}", {"image.threshold.above: or below must be given"}},
    {"metres_for_millimetres",
     "file: grey.mha, threshold: {above: 200}, unit: m",
     {"which no vessel is", "or image.unit is wrong"}},
    {"no_image", "file: study.yaml, threshold: {above: 200}", {"study.yaml: an image is .mha"}},
};
INSTANTIATE_TEST_SUITE_P(BadImage, WrongStudy, ::testing::ValuesIn(wrong),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BadImage, FilesThatAreNoGreyVolumeAreRefused) {
  const Folder folder;
  const auto refusal = [&](const std::string& file) {
    return folder.refusal("file: " + file + ", threshold: {above: 1}");
  };
  const std::string bytes(27, '\2'), of_two(24, '\2');
  folder.text("flat.mha", "NDims = 2\nDimSize = 5 5\nElementType = MET_UCHAR\n", bytes.substr(2));
  expect_said(refusal("flat.mha"), {"flat.mha: is not a volume: 5 x 5 x 1"});
  folder.text("one_slice.mha", "NDims = 3\nDimSize = 5 5 1\nElementType = MET_UCHAR\n", bytes.substr(2));
  expect_said(refusal("one_slice.mha"), {"is not a volume: 5 x 5 x 1"});
  folder.text("film.mha", "NDims = 4\nDimSize = 2 2 2 3\nElementType = MET_UCHAR\n", of_two);
  expect_said(refusal("film.mha"), {"film.mha: has 4 dimensions, 3 images in a row"});
  folder.text("colour.mha", "NDims = 3\nDimSize = 2 2 2\nElementNumberOfChannels = 3\nElementType = MET_UCHAR\n",
              of_two);
  expect_said(refusal("colour.mha"), {"colour.mha: has 3 values a voxel"});
  folder.text("cut.mha", "NDims = 3\nDimSize = 9 9 9\nElementType = MET_UCHAR\n", bytes);
  expect_said(refusal("cut.mha"), {"cut.mha: its voxels take 729 bytes, it has 27: cut short?"});
  folder.text("huge.mha", "NDims = 3\nDimSize = 1000 1000 1500\nElementType = MET_SHORT\n", bytes);
  fs::resize_file(folder.path / "huge.mha", 3'000'001'000);  // of zeros, of which few blocks are on the disk
  expect_said(refusal("huge.mha"), {"huge.mha: its voxels take 3000 MB: more than the 1200 MB that are read here"});
  folder.text("sheared.mha",
              "NDims = 3\nDimSize = 3 3 3\nTransformMatrix = 1 0 0 0 1 0.3 0 0 1\nElementType = MET_UCHAR\n", bytes);
  expect_said(refusal("sheared.mha"), {"sheared.mha: the header's axes are not at right angles"});
  folder.text("no_size.mha", "NDims = 3\nDimSize = 3 3 3\nElementSpacing = 1 1 0\nElementType = MET_UCHAR\n", bytes);
  expect_said(refusal("no_size.mha"), {"no_size.mha: ElementSpacing: '1 1 0': must be positive"});
  std::ofstream(folder.path / "alone.mhd")
      << "ObjectType = Image\nNDims = 3\nDimSize = 3 3 3\nElementType = MET_UCHAR\nElementDataFile = alone.raw\n";
  expect_said(refusal("alone.mhd"), {"alone.mhd: names the file alone.raw, which is not there"});
  std::ofstream(folder.path / "zeros.mhd")
      << "ObjectType = Image\nNDims = 3\nDimSize = 3 3 3\nElementType = MET_UCHAR\nElementDataFile = /dev/zero\n";
  expect_said(refusal("zeros.mhd"), {"zeros.mhd: names the file /dev/zero, which is a device or a pipe"});
  std::ofstream(folder.path / "long.nrrd")
      << "NRRD0004\ntype: uchar\ndimension: 1\nsizes: 1\nencoding: raw\ndata file: " << std::string(300, 'n') << "\n\n";
  expect_said(refusal("long.nrrd"), {"long.nrrd: names the file nnn", "nnn, which is not there"});
  std::ofstream(folder.path / "alone.nhdr")
      << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nencoding: raw\ndata file: alone.raw\n";
  expect_said(refusal("alone.nhdr"), {"alone.nhdr: ", "alone.raw"});
  std::ofstream(folder.path / "slice.dcm") << "DICM";
  expect_said(refusal("slice.dcm"), {"slice.dcm: an image is .mha", "a DICOM series becomes one by"});
  std::ofstream(folder.path / "words.nrrd") << "no image at all";
  expect_said(refusal("words.nrrd"), {"words.nrrd: is not an image"});
}

/// ITK writes past its arrays, takes the memory or aborts.
TEST(BadImage, HeadersThatStateTooMuchAreRefused) {
  const Folder folder;
  const auto refusal_of_meta = [&](const std::string& header) {
    folder.text("a.mha", header + "ElementType = MET_UCHAR\n", std::string(27, '\2'));
    return folder.refusal("file: a.mha, threshold: {above: 1}");
  };
  expect_said(refusal_of_meta("NDims = 12\nDimSize = 1 1 1 1 1 1 1 1 1 1 1 1\n"),
              {"NDims: '12': must be from 1 to 10"});
  expect_said(refusal_of_meta("NDims = 3\nDimSize = 3 3\n"), {"DimSize: '3 3': must be NDims numbers"});
  expect_said(refusal_of_meta("NDims = 3\nDimSize = 3 3 -3\n"), {"DimSize: '3 3 -3': must be from 1"});
  expect_said(refusal_of_meta("NDims = 3\nDimSize = 3 3 2000000000\n"), {"18000000000 bytes, it has 27"});
  expect_said(refusal_of_meta("NDims = 3\nNDims = 4\n"), {"a.mha:3: NDims is given twice"});
  expect_said(refusal_of_meta("Comment = " + std::string(250, 'x') + "\n"), {"a.mha:2: a line of text was expected"});
  expect_said(refusal_of_meta("NDims = 3\nElementDataFile = %s.raw 1 2 1\n"), {"must be LOCAL or one file"});

  const auto refusal_of_nrrd = [&](const std::string& header) {
    std::ofstream(folder.path / "a.nrrd") << "NRRD0004\ntype: uchar\n" << header << "\n\2\2\2\2\2\2\2\2";
    return folder.refusal("file: a.nrrd, threshold: {above: 1}");
  };
  expect_said(refusal_of_nrrd("dimension: 3\nsizes: 9 9 9999999\nencoding: raw\n"), {"bytes, it has 8"});
  expect_said(refusal_of_nrrd("dimension: 3\nsizes: 2 2 2\nencoding: gzip\n"), {"compressed voxels cannot be read"});
  expect_said(refusal_of_nrrd("dimension: 3\nsizes: 2 2 2\nencoding: rle\n"), {"encoding: 'rle': must be raw"});
  expect_said(refusal_of_nrrd("dimension: 4\nsizes: 2 2 2\nencoding: raw\n"), {"sizes: '2 2 2': must be as many"});
  const std::string head = "dimension: 3\nsizes: 2 2 2\nencoding: raw\n";
  std::string keys, fields;
  for (int i = 0; i < 10'000; ++i) keys += fmt::format("k{}:=v\n", i), fields += fmt::format("K{} = 1\n", i);
  expect_said(refusal_of_nrrd(head + keys), {"a.nrrd:10001: the header has more than 10000 lines"});
  EXPECT_EQ(refusal_of_nrrd(head + keys.substr(0, keys.find("k9000:"))).find("lines"), std::string::npos);
  for (int i = 0; i < 11; ++i) keys.insert(0, "l:=" + std::string(1'000'000, 'v') + "\n");
  expect_said(refusal_of_nrrd(head + keys), {"the header has more than 10 MB"});
  const std::string name(1000, 'n');  // teem would write it beyond the end of its stack
  expect_said(refusal_of_nrrd(head + name + ": 1\n"), {"a field of no more than 500 characters was expected"});
  EXPECT_EQ(refusal_of_nrrd(head + name + ":=1\n").find("500"), std::string::npos) << "3D Slicer tells much so";
  folder.text("a.mha", fields);
  expect_said(folder.refusal("file: a.mha, threshold: {above: 1}"), {"a.mha:10001: the header has more than 10000"});

  write_image(folder.path / "a.nii", tube_image());
  std::fstream nifti(folder.path / "a.nii", std::ios::in | std::ios::out | std::ios::binary);
  const float nan = NAN;
  nifti.seekp(280);
  nifti.write(reinterpret_cast<const char*>(&nan), sizeof nan);
  nifti.close();
  expect_said(folder.refusal("file: a.nii, threshold: {above: 1}"), {"states a place or an axis of nan"});
}

/// MetaIO makes a mirrored image of them, or tells a false cause in five lines; ITK one that names its own sources.
TEST(BadImage, PlacesAndSpacingsThatNoImageHasAreRefused) {
  const Folder folder;
  const auto meta = [&](const std::string& field) {
    folder.text("a.mha", "NDims = 3\nDimSize = 3 3 3\n" + field + "\nElementType = MET_UCHAR\n", std::string(27, '\2'));
    return folder.refusal("file: a.mha, threshold: {above: 1}");
  };
  expect_said(meta("ElementSpacing = -1 1 1"), {"a.mha: ElementSpacing: '-1 1 1': must be positive"});
  expect_said(meta("ElementSpacing = nan 1 1"), {"a.mha: ElementSpacing: 'nan 1 1': must be finite numbers"});
  expect_said(meta("ElementSpacing = 1 1"), {"a.mha: ElementSpacing: '1 1': must be 3 numbers"});
  expect_said(meta("ElementSize = 1 0 1"), {"a.mha: ElementSize: '1 0 1': must be positive"});
  expect_said(meta("Offset = 0 inf 0"), {"a.mha: Offset: '0 inf 0': must be finite numbers"});
  expect_said(meta("TransformMatrix = 1 0 0 0 1 0 0 0"), {"TransformMatrix", "must be 9 numbers"});

  const auto nrrd = [&](const std::string& fields) {
    std::ofstream(folder.path / "a.nrrd") << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                                          << fields << "\n\n\2\2\2\2\2\2\2\2";
    return folder.refusal("file: a.nrrd, threshold: {above: 1}");
  };
  const std::string space = "space: left-posterior-superior\n";
  expect_said(nrrd("space directions: (1,0,0) (0,1,0) (0,0,1)"),
              {"a.nrrd:6: space directions stands before a space: must be behind one"});
  expect_said(nrrd("spacings: 1 -1 1"), {"a.nrrd: spacings: '1 -1 1': must be positive"});
  expect_said(nrrd("spacings: 1 nan 1"), {"a.nrrd: spacings: '1 nan 1': must be finite"});
  for (const char* third : {"(0,0,0)", "(0,0,inf)", "(0,0,x)"})
    expect_said(nrrd(space + "space directions: (1,0,0) (0,1,0) " + third), {"must be vectors of finite numbers"});
  expect_said(nrrd(space + "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,nan,0)"),
              {"spaceorigin: '(0,nan,0)': must be finite"});
  const std::string said = nrrd(space + "space directions: (1,0,0) (0,1,0)");
  expect_said(said, {"a.nrrd: cannot be read: "});
  EXPECT_EQ(said.find("nrrd]"), std::string::npos) << said;
  EXPECT_EQ(said.find("0x"), std::string::npos) << said;

  for (const auto& [place, number] : {std::pair{80, -1.0F}, {88, 0.0F}}) {
    write_image(folder.path / "a.nii", tube_image());
    std::fstream nifti(folder.path / "a.nii", std::ios::in | std::ios::out | std::ios::binary);
    nifti.seekp(place);
    nifti.write(reinterpret_cast<const char*>(&number), sizeof number);
    nifti.close();
    expect_said(folder.refusal("file: a.nii, threshold: {above: 1}"), {"a.nii: pixdim[", "must be positive"});
  }
}

/// ITK takes them for millimetres: a vessel ten times too large, or one whose spacing is right and whose place is not.
TEST(BadImage, UnitsOtherThanMillimetresAreRefused) {
  const Folder folder;
  const auto refusal = [&](const std::string& file) {
    return folder.refusal("file: " + file + ", threshold: {above: 1}");
  };
  const auto meta = [&](const std::string& field) {
    folder.text("a.mha", "NDims = 3\nDimSize = 3 3 3\n" + field + "\nElementType = MET_UCHAR\n", std::string(27, '\2'));
    return refusal("a.mha");
  };
  expect_said(meta("DistanceUnits = cm"), {"a.mha: DistanceUnits: 'cm': must be mm"});
  expect_said(meta("ElementToIntensityFunctionSlope = 0.01"),
              {"a.mha: ElementToIntensityFunctionSlope: '0.01': must be 1"});
  expect_said(meta("ElementToIntensityFunctionOffset = -1024"),
              {"a.mha: ElementToIntensityFunctionOffset: ", "must be 0"});
  for (const char* plain : {"DistanceUnits = mm", "DistanceUnits = ?", "ElementToIntensityFunctionSlope = 1.0",
                            "ElementToIntensityFunctionOffset = 0"})
    EXPECT_EQ(meta(plain).find("a.mha: E") + meta(plain).find("a.mha: D"), 2 * std::string::npos) << meta(plain);

  const auto nrrd = [&](const std::string& field) {
    std::ofstream(folder.path / "a.nrrd") << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
                                          << field << "\n\n\2\2\2\2\2\2\2\2";
    return refusal("a.nrrd");
  };
  const std::string space = "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n";
  expect_said(nrrd(space + "space units: \"mm\" \"mm\" \"cm\""),
              {"a.nrrd: spaceunits: '\"mm\" \"mm\" \"cm\"': must be mm"});
  expect_said(nrrd("spacings: 1 1 1\nunits: \"um\" \"um\" \"um\""), {"a.nrrd: units: ", "must be mm"});
  const std::string plain = nrrd(space + "space units: \"mm\" \"mm\" \"\"");
  EXPECT_EQ(plain.find("spaceunits"), std::string::npos) << plain;
}

TEST(BadImage, NiftisOfOtherUnitsOrTwoSpacingsAreRefused) {
  const Folder folder;
  const auto refusal = [&](auto place, auto value) {
    write_image(folder.path / "a.nii", tube_image());
    std::fstream nifti(folder.path / "a.nii", std::ios::in | std::ios::out | std::ios::binary);
    nifti.seekp(place);
    nifti.write(reinterpret_cast<const char*>(&value), sizeof value);
    nifti.close();
    return folder.refusal("file: a.nii, threshold: {above: 200}");
  };
  constexpr int units_at = 123, spacing_at = 80, rows_are_meant_at = 254, first_row_at = 280;
  expect_said(refusal(units_at, std::uint8_t{1 + 8}),
              {"a.nii: xyzt_units: its lengths are metres: must be millimetres (2)"});
  expect_said(refusal(units_at, std::uint8_t{3}), {"a.nii: xyzt_units: its lengths are micrometres"});
  expect_said(refusal(units_at, std::uint8_t{7}), {"a.nii: xyzt_units: its lengths are of the unit 7"});
  expect_said(refusal(spacing_at, 3.0F),
              {"a.nii: pixdim[1]: 3: the sform", "has a spacing of 1.5 there: must be the same"});
  expect_said(refusal(first_row_at, -1.51F), {"a.nii: pixdim[1]: 1.5: the sform", "has a spacing of 1.51"});
  EXPECT_EQ(refusal(first_row_at, -1.5001F), "was not refused");
  EXPECT_EQ(refusal(units_at, std::uint8_t{0}), "was not refused");
  EXPECT_EQ(refusal(rows_are_meant_at, std::int16_t{0}), "was not refused") << "the quaternion tells the axes";
}

/// A header that states a slice less than there is.
TEST(BadImage, VoxelsBehindThoseThatTheHeaderStatesAreRefused) {
  const Folder folder;
  const auto refusal = [&](const std::string& file) {
    return folder.refusal("file: " + file + ", threshold: {above: 1}");
  };
  const std::string size = "NDims = 3\nDimSize = 3 3 2\nElementType = MET_UCHAR\n", bytes(27, '\2');
  folder.text("a.mha", size, bytes);
  expect_said(refusal("a.mha"), {"a.mha: its voxels take 18 bytes by its header, it has 27: must be as many"});
  std::ofstream(folder.path / "a.raw") << bytes;
  std::ofstream(folder.path / "a.mhd") << size << "ElementDataFile = a.raw\n";
  expect_said(refusal("a.mhd"), {"a.raw: its voxels take 18 bytes", "must be as many, or HeaderSize be given"});
  for (const char* skip : {"HeaderSize = 0\n", "HeaderSize = 9\n", "HeaderSize = -1\n"}) {
    std::ofstream(folder.path / "a.mhd") << size << skip << "ElementDataFile = a.raw\n";
    EXPECT_EQ(refusal("a.mhd").find("its voxels take"), std::string::npos) << refusal("a.mhd");
  }
  std::ofstream(folder.path / "a.nrrd") << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 2\nencoding: raw\n\n"
                                        << bytes;
  expect_said(refusal("a.nrrd"), {"a.nrrd: its voxels take 18 bytes by its header, it has 27"});

  for (const char* file : {"a.nii", "a.nii.gz"}) {
    write_image(folder.path / file, tube_image());
    std::ostringstream once;
    once << std::ifstream(folder.path / file, std::ios::binary).rdbuf();
    std::ofstream(folder.path / file, std::ios::binary | std::ios::app) << once.str();
    expect_said(refusal(file), {file, "bytes by its header", "must be as many"});
  }
}

/// Voxels as text: each is a number.
TEST(BadImage, AsManyNumbersAsVoxelsAreAskedFor) {
  const Folder folder;
  const auto refusal = [&](const std::string& file) {
    return folder.refusal("file: " + file + ", threshold: {above: 1}");
  };
  const std::string size = "NDims = 3\nDimSize = 3 3 2\nElementType = MET_UCHAR\nBinaryData = False\n";
  std::string eighteen;
  for (int voxel = 0; voxel < 18; ++voxel) eighteen += voxel % 3 == 2 ? "12\n" : "12 ";
  for (const auto& [numbers, told] : {std::pair(eighteen + "7", "has 19 numbers, its header states 18"),
                                      {eighteen.substr(3), "has 17 numbers, its header states 18"}}) {
    folder.text("a.mha", size, numbers);
    expect_said(refusal("a.mha"), {"a.mha", told});
    std::ofstream(folder.path / "a.nrrd") << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 3 2\nencoding: ascii\n\n"
                                          << numbers;
    expect_said(refusal("a.nrrd"), {"a.nrrd", told});
  }
  folder.text("a.mha", size, eighteen);
  EXPECT_EQ(refusal("a.mha").find("numbers"), std::string::npos) << refusal("a.mha");
}

/// A compressed file that ends early, of each kind.
TEST(BadImage, ATruncatedFileIsRefused) {
  const Folder folder;
  for (const char* file : {"cut.mha", "cut.nrrd", "cut.nii.gz", "cut.nii"}) {
    write_image(folder.path / file, tube_image());
    fs::resize_file(folder.path / file, fs::file_size(folder.path / file) / 2);
    const std::string message = folder.refusal(std::string("file: ") + file + ", threshold: {above: 200}");
    expect_said(message, {file});
    EXPECT_NE(message, "was not refused") << file;
    EXPECT_EQ(message.find("openings"), std::string::npos) << message;
  }
}

/// One byte in the middle of the compressed voxels is another.
TEST(BadImage, DamagedVoxelsAreRefused) {
  const Folder folder;
  for (const char* file : {"hurt.mha", "hurt.nrrd", "hurt.nii.gz"}) {
    write_image(folder.path / file, tube_image());
    std::fstream bytes(folder.path / file, std::ios::binary | std::ios::in | std::ios::out);
    const auto middle = static_cast<std::streamoff>(fs::file_size(folder.path / file) / 2);
    bytes.seekg(middle);
    const auto there = static_cast<char>(bytes.get() ^ 0x55);
    bytes.seekp(middle);
    bytes.put(there);
    bytes.close();
    const std::string message = folder.refusal(std::string("file: ") + file + ", threshold: {above: 200}");
    expect_said(message, {file});
    EXPECT_EQ(message.find("openings"), std::string::npos) << message;
  }
}

TEST(BadImage, ValuesThatAreNotFiniteAreRefused) {
  const Folder folder;
  ImageVolume image = tube_image();
  image.values[image.at(3, 2, 1)] = image.values[image.at(4, 4, 4)] = std::numeric_limits<float>::quiet_NaN();
  write_image(folder.path / "nan.mha", image);
  expect_said(folder.refusal("file: nan.mha, threshold: {above: 200}"), {"2 voxels", "not finite", "voxel 3 2 1"});
}

TEST(OddImage, ObliqueAndLeftHandedAxesGiveTheSameLumenInThePatientsCoordinates) {
  const Folder folder;
  Mat3 turned = (Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  Mat3 mirrored = Mat3::Identity();
  mirrored(2, 2) = -1;
  for (const Mat3& axes : {turned, mirrored})
    for (const char* file : {"tube.mha", "tube.nrrd", "tube.nii.gz"}) {
      write_image(folder.path / file, tube_image(Vec3::Constant(0.15), axes));
      const auto at = [&](const Vec3& x) {
        const Vec3 y = axes * x;
        return fmt::format("[{}, {}, {}]", y[0], y[1], y[2]);
      };
      const BuiltSurface built = build_surface(
          folder.study(std::string("file: ") + file + ", threshold: {above: 200}", at({4, 0, 0}), at({-2, 3.46, 0})));
      EXPECT_NEAR(built.summary.surface.volume, tube_volume(), 0.02 * tube_volume()) << file;
      EXPECT_TRUE(built.summary.openings[0].at_image_border);
      EXPECT_LT((built.summary.openings[0].centre - axes * Vec3(4, 0, 0)).norm(), 0.02) << file;
      for (const RepairNote& note : built.summary.repairs) EXPECT_NE(note.kind, RepairKind::triangles_turned) << file;
    }
}

TEST(OddImage, MixedSpacingWorksAndIsNoted) {
  const Folder folder;
  write_image(folder.path / "tube.mha", tube_image({0.08, 0.1, 0.3}));
  const BuiltSurface built = build_surface(folder.study("file: tube.mha, threshold: {above: 200}"));
  EXPECT_NEAR(built.summary.surface.volume, tube_volume(), 0.03 * tube_volume());
  expect_said(text_of(built.summary), {"a voxel is 3.8 times as long as wide"});
}

/// A room beside the tube, joined with it by a gap of three voxels.
ImageVolume with_room(double grey = 350) {
  ImageVolume image = tube_image();
  for (std::size_t n = 0; n < image.values.size(); ++n) {
    const Vec3 x = image.place(n);
    const bool gap = std::hypot(x[0] - x[1], x[2]) < 0.3 && x[0] > 1.2 && x[0] < 2.4;
    if ((x - Vec3(1, 1, 0)).norm() < 0.9 || gap) image.values[n] = std::max(image.values[n], static_cast<float>(grey));
  }
  return image;
}

TEST(OddImage, ALeakIsToldWithItsPlaceAndMendedByAStop) {
  const Folder folder;
  write_image(folder.path / "tube.mha", with_room());
  for (const std::string method : {"threshold: {above: 200}"}) {
    const std::string image = "file: tube.mha, seeds: {middle: [2, 3.46, 0]}, " + method;
    const BuiltSurface leaking = build_surface(folder.study(image));
    ASSERT_GT(leaking.summary.image->room_radius, 0.7) << method;
    EXPECT_LT((leaking.summary.image->door_place - Vec3(1.9, 1.9, 0)).norm(), 0.5) << method;
    expect_said(text_of(leaking.summary), {"look at it: behind a door of radius 0.", "image.stops"});
    const BuiltSurface stopped =
        build_surface(folder.study(image + ", stops: {gap: {point: [1.84, 1.84, 0], radius: 3.6 mm}}"));
    EXPECT_EQ(stopped.summary.image->room_radius, 0) << method;
    EXPECT_NEAR(stopped.summary.surface.volume, tube_volume(), 0.02 * tube_volume()) << method;
  }
}

TEST(OddImage, WhatDoesNotHangTogetherWithASeedIsLeftOut) {
  const Folder folder;
  ImageVolume image = tube_image();
  for (int k = 0; k < 20; ++k)  // a bone
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 14; ++i) image.values[image.at(i, j, k)] = 900;
  image.values[image.at(45, 33, 3)] = 400;
  write_image(folder.path / "tube.mha", image);
  const BuiltSurface built = build_surface(
      folder.study("file: tube.mha, threshold: {above: 200}, smoothing: 0, seeds: {middle: [2, 3.46, 0]}"));
  ASSERT_TRUE(built.summary.image);
  EXPECT_EQ(built.summary.image->parts_dropped, 2);
  EXPECT_NEAR(built.summary.surface.volume, tube_volume(), 0.02 * tube_volume());
}

}  // namespace
}  // namespace tether
