#include "common/io/lumen_motion.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

Points imaged() {
  return Points::Random(3, 7);
}

/// The k-th of some displacements.
Points moved(int k) {
  return Points::Constant(3, 7, 0.125 * k);
}

struct MotionFile {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "lumen.motion";
  Points x = imaged();
  void write(int records) {
    LumenMotionWriter writer(path, x);
    writer.start();
    checksums = {writer.checksum()};
    for (int k = 0; k < records; ++k) {
      writer.append(0.5 * k, moved(k));
      checksums.push_back(writer.checksum());
    }
  }
  std::vector<std::uint64_t> checksums = {};  ///< behind so many records
};

TEST(LumenMotion, IsReadBackAndLinearBetweenSteps) {
  MotionFile file;
  file.write(4);
  const LumenMotion motion(file.path);
  EXPECT_EQ(motion.imaged(), file.x);
  EXPECT_EQ(motion.times(), (std::vector<double>{0, 0.5, 1, 1.5}));
  EXPECT_EQ(motion.at(0.5), file.x + moved(1));
  EXPECT_LT((motion.at(1.125) - file.x - 2.25 * moved(1)).norm(), 1e-14);
  EXPECT_LT((motion.at(1.5 + 1e-9) - file.x - moved(3)).norm(), 1e-14);
  EXPECT_THROW(motion.at(1.6), InputError);
  EXPECT_THROW(motion.at(-0.1), InputError);
}

TEST(LumenMotion, GoesOnAfterAResumeAsIfNeverStopped) {
  MotionFile whole, resumed;
  resumed.x = whole.x;
  whole.write(6);
  resumed.write(4);  // one more than the checkpoint knows
  LumenMotionWriter writer(resumed.path, resumed.x);
  writer.resume(3, whole.checksums[3]);
  for (int k = 3; k < 6; ++k) writer.append(0.5 * k, moved(k));
  const auto bytes = [](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes(whole.path), bytes(resumed.path));
  std::fstream(resumed.path, std::ios::binary | std::ios::in | std::ios::out).seekp(-20, std::ios::end) << "damaged";
  EXPECT_THROW(writer.resume(6, whole.checksums[6]), InputError);
  const std::string before = bytes(resumed.path);
  EXPECT_THROW(writer.resume(7, whole.checksums[6]), InputError);
  EXPECT_EQ(bytes(resumed.path), before);
  LumenMotionWriter(resumed.path, resumed.x).resume(5, whole.checksums[5]);
  EXPECT_EQ(LumenMotion(resumed.path).times().size(), 5) << "what is dropped may be damaged";
  EXPECT_THROW(LumenMotionWriter(resumed.path, imaged().array() + 1).resume(3, whole.checksums[3]), InputError);
}

/// Of the same points and as many records, each of them whole.
TEST(LumenMotion, DoesNotGoOnWithThatOfAnotherRun) {
  MotionFile own, other;
  other.x = own.x;
  own.write(4);
  LumenMotionWriter writer(other.path, other.x);
  writer.start();
  for (int k = 0; k < 4; ++k) writer.append(0.5 * k, moved(k + 1));
  try {
    LumenMotionWriter(other.path, other.x).resume(3, own.checksums[3]);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              other.path.string() + ": is the motion of a lumen of another run: not what the checkpoint belongs to");
  }
  EXPECT_EQ(LumenMotion(other.path).times().size(), 4) << "it is as it was";
}

TEST(LumenMotion, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "other") << "something else that is long enough to hold a title";
  EXPECT_THROW(LumenMotion{folder / "other"}, InputError);
  EXPECT_THROW(LumenMotion{folder / "none"}, InputError);
}

/// A run that was killed while it wrote: the part of a record at the end is no record.
TEST(LumenMotion, AHalfWrittenRecordIsNone) {
  MotionFile file;
  file.write(3);
  std::filesystem::resize_file(file.path, std::filesystem::file_size(file.path) - 5);
  EXPECT_EQ(LumenMotion(file.path).times().size(), 2u);
}

/// Any bit that is wrong, wherever.
TEST(LumenMotion, DamageIsSeen) {
  MotionFile file;
  file.write(3);
  const auto size = std::filesystem::file_size(file.path);
  for (std::uintmax_t at = 0; at < size; at += 3) {
    std::fstream bytes(file.path, std::ios::binary | std::ios::in | std::ios::out);
    bytes.seekg(static_cast<std::streamoff>(at));
    const char was = static_cast<char>(bytes.get());
    const auto put = [&](char value) {
      bytes.seekp(static_cast<std::streamoff>(at));
      bytes.put(value).flush();
    };
    put(static_cast<char>(was ^ 0x10));
    EXPECT_THROW(LumenMotion{file.path}, InputError) << at;
    put(was);
  }
  EXPECT_EQ(LumenMotion(file.path).times().size(), 3U);
}

TEST(LumenMotion, ACutRunIsNotTakenForAWholeOne) {
  MotionFile file;
  file.write(4);
  EXPECT_NO_THROW(LumenMotion(file.path).check_has(3));
  std::filesystem::resize_file(file.path, std::filesystem::file_size(file.path) - 1);
  EXPECT_THROW(LumenMotion(file.path).check_has(3), InputError);
}

}  // namespace
}  // namespace tether
