#include "common/base/checked_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

TEST(CheckedFile, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  const std::vector<std::byte> bytes{std::byte{1}, std::byte{2}};
  write_checked(folder / "master.bin", 7, 3, bytes);
  const CheckedContent content = read_checked(folder / "master.bin");
  EXPECT_EQ(content.fingerprint, 7U);
  EXPECT_EQ(content.step, 3);
  EXPECT_EQ(content.bytes, bytes);
}

/// To open a pipe that nobody writes to would wait without end.
TEST(CheckedFile, IsNoPipe) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "fluid.bin").c_str(), 0600), 0);
  EXPECT_EQ(message_of([&] { read_checked(folder / "fluid.bin"); }),
            (folder / "fluid.bin").string() + ": is not a file");
  EXPECT_EQ(message_of([&] { content_of(folder / "fluid.bin"); }), (folder / "fluid.bin").string() + ": is not a file");
}

TEST(Content, HasALimit) {
  const TemporaryFolder folder;
  EXPECT_EQ(content_of(folder.file("text", "ten  bytes"), 10), "ten  bytes");
  std::filesystem::resize_file(folder / "text", 3'000'000'000);
  EXPECT_EQ(message_of([&] { content_of(folder / "text", 16'000'000); }),
            (folder / "text").string() + ": has 3000 MB: larger than any such file that is read here (16 MB)");
}

}  // namespace
}  // namespace tether
