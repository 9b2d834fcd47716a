/// Packets between two processes of one host.
#include "common/protocol/socket_channel.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "common/protocol/partner.hpp"

namespace tether::protocol {
namespace {

class Sockets : public ::testing::Test {
 protected:
  SocketListener listener;
  std::unique_ptr<SocketChannel> there = connect_to({"asker"}, listener.path());
  std::unique_ptr<SocketChannel> here = listener.accept({"service"}, [] { return true; });
};

TEST_F(Sockets, Keep_the_order_of_packets_small_and_large) {
  const State large{std::vector<double>(2'000'000, 0.25)};
  std::thread other([&] {
    there->send(pack(Ready{}));
    there->send(pack(large));
    there->send(pack(Failure{"late", false}));
  });
  EXPECT_TRUE(holds<Ready>(here->receive(infinite)));
  EXPECT_EQ(unpack<State>(here->receive(infinite)).values, large.values);
  EXPECT_EQ(unpack<Failure>(here->receive(infinite)).message, "late");
  other.join();
  EXPECT_FALSE(here->has_packet());
  EXPECT_THROW(here->receive(0.01), PeerSilent);
}

TEST_F(Sockets, Say_at_once_that_the_other_end_is_gone) {
  EXPECT_FALSE(here->is_left());
  there->send(pack(Ready{}));
  there.reset();
  EXPECT_TRUE(here->is_left());
  EXPECT_TRUE(holds<Ready>(here->receive(infinite))) << "what was said before is heard";
  EXPECT_THROW(here->receive(infinite), PeerDied);
  EXPECT_THROW(here->send(pack(Ready{})), PeerDied);
}

TEST_F(Sockets, Leave_nothing_on_the_disk) {
  EXPECT_FALSE(std::filesystem::exists(listener.path().parent_path()));
}

TEST_F(Sockets, Carry_a_partner) {
  std::thread other([&] {
    Hello hello;
    hello.parameters = {{"solid.density", "", "g/cm3", "log", 1.2, undefined, 0, infinite, undefined, undefined}};
    there->send(pack(hello));
    const auto order = unpack<OrderRuns>(there->receive(infinite));
    there->send(pack(Ready{}));
    static_cast<void>(unpack<NextRun>(there->receive(infinite)));
    there->send(pack(RunEnded{order.runs.at(0).folder, "", true, 7, 0.5}));
  });
  Partner partner(std::move(here));
  EXPECT_EQ(partner.hello().parameters.at(0).upper, infinite);
  partner.ask(OrderRuns{{{"a/run", {"solid.density"}, {1.1}}}, {}});
  const RunEnded ended = partner.ask(NextRun{});
  EXPECT_EQ(ended.folder, "a/run");
  EXPECT_EQ(ended.evaluations, 7);
  other.join();
}

TEST(SocketListener, Waits_only_as_long_as_somebody_may_come) {
  std::filesystem::path folder;
  {
    const SocketListener listener;
    folder = listener.path().parent_path();
    EXPECT_TRUE(std::filesystem::exists(listener.path()));
    EXPECT_EQ(listener.accept({"nobody"}, [] { return false; }), nullptr);
  }
  EXPECT_FALSE(std::filesystem::exists(folder));
  EXPECT_THROW(connect_to({"asker"}, folder / "socket"), RunError);
}

}  // namespace
}  // namespace tether::protocol
