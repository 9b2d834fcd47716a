#include "common/protocol/nodes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/base/error.hpp"

namespace tether::protocol {
namespace {

using Names = std::vector<std::string>;

TEST(Nodes, OneThatRunsAnswersWhetherItHasSshOrNot) {
  EXPECT_EQ(silent_nodes({"127.0.0.1", "localhost"}, 5), Names());
}

/// One that is there and silent: tests/hosts.
TEST(Nodes, OneThatIsNowhereIsNamed) {
  const char* nowhere = "no-such-host.invalid";  // RFC 2606
  EXPECT_EQ(silent_nodes({"127.0.0.1", nowhere}, 5), Names{nowhere});
}

TEST(Nodes, ThisMachineIsKnownByItsAddress) {
  EXPECT_TRUE(is_here("localhost"));
  EXPECT_FALSE(is_here("192.0.2.1"));  // kept for documents (RFC 5737)
  EXPECT_FALSE(is_here("no-such-host.invalid"));
}

TEST(Nodes, AJobHasSeveralOrNoneThatMatters) {
  setenv(nodes_variable, "n1,, n2", 1);
  EXPECT_EQ(nodes_of_job(), (Names{"n1", "n2"}));
  EXPECT_EQ(own_node(), "n1");
  EXPECT_TRUE(is_on_first_node());
  setenv(node_variable, "n2", 1);
  EXPECT_EQ(own_node(), "n2");
  EXPECT_FALSE(is_on_first_node());
  for (const char* wrong : {"n1:4,n2", "n1;n2", "n1,n2,n1", ","}) {
    setenv(nodes_variable, wrong, 1);
    EXPECT_THROW(nodes_of_job(), InputError) << wrong;
  }
  setenv(nodes_variable, "n1", 1);
  EXPECT_EQ(nodes_of_job(), Names());
  EXPECT_EQ(own_node(), "");
  EXPECT_TRUE(is_on_first_node());
  unsetenv(nodes_variable);
  unsetenv(node_variable);
}

}  // namespace
}  // namespace tether::protocol
