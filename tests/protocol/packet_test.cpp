#include "common/protocol/packet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace tether::protocol {
namespace {

TEST(Packet, Goes_there_and_back_with_nested_fields) {
  Hello hello;
  hello.program = "solid 1.2";
  hello.has_state = true;
  hello.state_size = 1234567890123;
  hello.parameters = {{"stiffness", "of the spine", "dyn/cm3", "log2", 0.1, std::nan(""), 0, 1e9, 1}, {}};
  hello.observables = {{"outlet.flow", "cm3/s"}};
  const auto copy = unpack<Hello>(pack(hello));
  EXPECT_EQ(copy.program, "solid 1.2");
  EXPECT_TRUE(copy.has_state);
  EXPECT_FALSE(copy.has_tangent);
  EXPECT_EQ(copy.state_size, 1234567890123);
  ASSERT_EQ(copy.parameters.size(), 2U);
  EXPECT_EQ(copy.parameters[0].unit, "dyn/cm3");
  EXPECT_EQ(copy.parameters[0].value, 0.1);
  EXPECT_TRUE(std::isnan(copy.parameters[0].absent));
  EXPECT_EQ(copy.observables.at(0).name, "outlet.flow");
}

TEST(Packet, Carries_samples) {
  const Discrepancy sent{{0.1}, {0, 0, 1}, {2.5}, {4, 5, 5}, {0.25, 0.75, 0}, {1}, {0}};
  const auto copy = unpack<Discrepancy>(pack(sent));
  EXPECT_EQ(copy.distances, sent.distances);
  EXPECT_EQ(copy.nodes, sent.nodes);
  EXPECT_EQ(copy.shares, sent.shares);
  EXPECT_EQ(copy.exclusions, sent.exclusions);
}

TEST(Packet, Has_the_documented_bytes) {
  const Packet packet = pack(Failure{"no", true});
  EXPECT_EQ(packet.kind, 3);
  const std::vector<int> expected{2, 0, 0, 0, 0, 0, 0, 0, 'n', 'o', 1, 0, 0, 0, 0, 0, 0, 0};
  ASSERT_EQ(packet.bytes.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(std::to_integer<int>(packet.bytes[i]), expected[i]) << i;
}

TEST(Packet, Refuses_too_few_and_too_many_bytes) {
  Packet packet = pack(Load{{1, 2, 3}});
  packet.bytes.pop_back();
  EXPECT_THROW(unpack<Load>(packet), MalformedMessage);
  packet = pack(Load{{1, 2, 3}});
  packet.bytes.push_back(std::byte{0});
  EXPECT_THROW(unpack<Load>(packet), MalformedMessage);
  EXPECT_THROW(unpack<Load>(Packet{packet.kind, {}}), MalformedMessage);
}

TEST(Packet, Refuses_absurd_counts_without_allocating) {
  for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{1} << 60}) {
    Writer writer;
    writer(count);
    EXPECT_THROW(unpack<Load>(Packet{kind_of<Load, ToMaster>, writer.take()}), MalformedMessage) << count;
  }
}

TEST(Packet, Refuses_a_bool_that_is_neither) {
  Writer writer;
  writer(std::int64_t{2});
  EXPECT_THROW(unpack<EndStep>(Packet{kind_of<EndStep, ToPartner>, writer.take()}), MalformedMessage);
}

TEST(Packet, Knows_names_and_limits) {
  EXPECT_EQ(kind_name<ToMaster>(kind_of<Load, ToMaster>), "Load");
  EXPECT_EQ(kind_name<ToPartner>(77), "kind 77");
  EXPECT_NO_THROW(check_message_size("State", largest_message));
  EXPECT_THROW(check_message_size("State", largest_message + 1), RunError);
}

/// The rows "| tag | `Name` |" of a direction's table that docs/protocol.md lacks.
template <class Direction>
std::vector<std::string> undocumented() {
  std::ifstream file("docs/protocol.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> missing;
  for (int kind = 0; kind < static_cast<int>(std::variant_size_v<Direction>); ++kind) {
    const std::string row = fmt::format("| {} | `{}` |", kind, kind_name<Direction>(kind));
    if (page.find(row) == std::string::npos) missing.push_back(row);
  }
  return missing;
}

TEST(Packet, Every_message_is_documented_with_its_tag) {
  EXPECT_EQ(undocumented<ToPartner>(), std::vector<std::string>{});
  EXPECT_EQ(undocumented<ToMaster>(), std::vector<std::string>{});
}

}  // namespace
}  // namespace tether::protocol
