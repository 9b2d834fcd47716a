#include "common/base/csv.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "tests/io/less_memory.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/io/work.hpp"

/// Tables larger than any that there are: refused soon, with little memory, in short messages.
namespace tether {
namespace {

std::string repeated(std::size_t times, const std::string& text) {
  std::string all;
  all.reserve(times * text.size());
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

/// What is said of a table behind its file's name; "accepted" if nothing is.
std::string said_of(const std::string& text) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.file("t.csv", text);
  const LessMemory than(300'000'000);
  const Work work;
  const std::string message = message_of([&] { CsvTable(file).numbers("flow"); });
  EXPECT_LT(work.seconds(), 10) << message;
  return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

TEST(Csv, LargerThanAnyTableIsRefused) {
  EXPECT_EQ(said_of("time [s],flow [ml/s]\n" + repeated(90'000'000, ",")),
            ":2: the line has 90000000 bytes: must be at most 1000000");
  EXPECT_EQ(said_of("time,flow\n" + repeated(20'000'000, "0,1\n")),
            ":10000002: the table has more than 20000000 cells up to here: must be at most so many");
  EXPECT_EQ(said_of(repeated(10'000, "a,") + "b\n"), ":1: has 10001 columns: must be at most 10000");
  EXPECT_EQ(said_of(repeated(8'000'000, "a,")), ":1: the line has 16000000 bytes: must be at most 1000000");
}

/// Of a simulation of 100,000 steps, and of velocities at 5,000 points and 200 times.
TEST(Csv, OfTheSizeThatTablesHaveIsRead) {
  EXPECT_EQ(said_of("flow" + repeated(49, ",") + "\n" + repeated(100'000, "0.125" + repeated(49, ",0.25") + "\n")),
            "accepted");
  EXPECT_EQ(said_of("flow,x,y,z,vx,vy,vz\n" + repeated(1'000'000, "0.1,1.25,1.5,1.75,10.5,20.5,30.5\n")), "accepted");
}

TEST(Csv, WhatIsLongIsQuotedWithoutItsMiddle) {
  const std::string x(100'000, 'x');
  for (const std::string& table : {"time,flow\n0," + x + "\n", "time," + x + "\n0,1\n", x + "," + x + "\n",
                                   "flow [" + x + "],flow [" + x + "]\n0,1\n"})
    EXPECT_LT(said_of(table).size(), 700U) << table.substr(0, 20);
  const std::string units = said_of("time,flow\n0,1" + x + "\n");
  EXPECT_EQ(units, ":2: flow: '1" + x.substr(0, 29) + " ... " + x.substr(0, 30) + "' is not a number");
}

/// Where its cells are is kept as places in its text, which moves with it.
TEST(Csv, CanBeCopiedAndMoved) {
  const TemporaryFolder folder;
  CsvTable table(folder.file("t.csv", "\xEF\xBB\xBF# of a person\na, b [mm]\r\n\"1\", +2\r\n\n 3 ,\"x y\""));
  const CsvTable copy = table, moved = std::move(table);
  for (const CsvTable* one : {&copy, &moved}) {
    EXPECT_EQ(one->numbers("a"), (std::vector<double>{1, 3}));
    EXPECT_EQ(one->texts("b"), (std::vector<std::string>{"+2", "x y"}));
    EXPECT_TRUE(one->where(1).ends_with("t.csv:5")) << one->where(1);
  }
}

}  // namespace
}  // namespace tether
