#include "common/protocol/partner.hpp"

#include <gtest/gtest.h>

#include <new>
#include <thread>

#include "common/base/process.hpp"
#include "common/protocol/run.hpp"
#include "tests/fakes/fake_fluid.hpp"
#include "tests/fakes/fake_solid.hpp"
#include "tests/protocol/in_process.hpp"

namespace tether::protocol {
namespace {

std::string message_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Partner, Answers_each_request_with_its_reply) {
  const auto solid = std::make_shared<fakes::FakeSolid>();
  Partner partner = in_process_partner<ToSolid>("solid", solid);
  EXPECT_EQ(partner.hello().unknowns, 54);
  partner.ask(BeginStep{3, 0.02, 0.01, std::vector<double>(54, 0.0)});
  const Motion motion = partner.ask(SolidEvaluate{std::vector<double>(54, 1.0)});
  EXPECT_DOUBLE_EQ(motion.velocity[7], 1 / (1 / 0.01 + 2 + 50 * 0.01));
  EXPECT_DOUBLE_EQ(motion.displacement[7], 0.01 * motion.velocity[7]);
}

/// What it costs is told apart from what its master does; its memory is that of both.
TEST(PartnerHere, Tells_what_its_answers_cost) {
  const auto answer = [](const Packet&) {
    volatile double sum = 0;
    for (const double begin = cpu_seconds(); cpu_seconds() < begin + 0.02;) sum = sum + 1;
    return pack(Ready{});
  };
  Partner partner(std::make_unique<LocalChannel>("fluid", pack(Hello{}), answer));
  partner.hello();
  EXPECT_TRUE(partner.is_here());
  EXPECT_EQ(partner.ask(GetUsage{}).cpu_seconds, 0);
  partner.ask(Write{});
  partner.ask(Write{});
  const double before = cpu_seconds();
  for (double busy = 0; cpu_seconds() < before + 0.1;) busy = busy + 1;
  const Usage usage = partner.ask(GetUsage{});
  EXPECT_GT(usage.cpu_seconds, 0.039);
  EXPECT_LT(usage.cpu_seconds, 0.1) << "what its master does meanwhile is the master's";
  EXPECT_GT(usage.peak_memory_mb, 0);
}

TEST(PartnerHere, Is_made_of_the_program_and_the_welcome) {
  std::vector<std::string> told;
  const Here here = partner_here<ToSolid>([&](const Program& program, const Welcome& welcome) {
    told = {program.arguments.front(), welcome.output};
    return fakes::FakeSolid();
  });
  Partner partner(here({"solid", "solid", {"case.yaml"}}, {version, "node7", 12, "out"}));
  EXPECT_EQ(partner.hello().unknowns, 54);
  EXPECT_EQ(told, (std::vector<std::string>{"case.yaml", "out"}));
  EXPECT_EQ(partner.peer().describe(), "solid");
  EXPECT_EQ(partner.ask(GetState{}).values.size(), 108U);
}

TEST(PartnerHere, Refuses_what_it_cannot_be_made_of) {
  const Here here = partner_here<ToSolid>([](const Program& program, const Welcome&) -> fakes::FakeSolid {
    throw input_error("{}:3: no such material", program.arguments.front());
  });
  Partner partner(here({"solid", "solid", {"case.yaml"}}, {}));
  EXPECT_THROW(partner.hello(), InputError);
}

struct Greedy : fakes::FakeSolid {
  using fakes::FakeSolid::operator();
  State operator()(const GetState&) { throw std::bad_alloc(); }
};

/// It would be taken for what the request deserves, and kept as that.
TEST(PartnerHere, Lack_of_memory_is_no_failure_of_a_request) {
  const Here here = partner_here<ToSolid>([](const Program&, const Welcome&) { return Greedy(); });
  Partner partner(here({"solid", "solid", {"case.yaml"}}, {version, "node7", 12, "out"}));
  EXPECT_EQ(partner.hello().unknowns, 54);
  EXPECT_THROW(partner.ask(GetState{}), std::bad_alloc);
}

TEST(Partner, Failure_names_role_step_and_reason_and_leaves_it_reachable) {
  const auto solid = std::make_shared<fakes::FakeSolid>();
  solid->has_tangent = false;
  Partner partner = in_process_partner<ToSolid>("solid", solid);
  partner.ask(BeginStep{12, 0.12, 0.01, std::vector<double>(54, 0.0)});
  EXPECT_THROW(partner.ask(SolidTangent{}), PartnerFailed);
  EXPECT_EQ(message_of([&] { partner.ask(SolidTangent{}); }),
            "solid failed while computing step 12 (SolidTangent): no tangent");
  EXPECT_THROW(partner.ask(SetParameters{{"colour"}, {1}}), InputError);
  EXPECT_EQ(partner.ask(GetState{}).values.size(), 108U);
}

TEST(Partner, A_request_for_another_role_is_a_failure) {
  Partner partner = in_process_partner<ToSolid>("solid", std::make_shared<fakes::FakeSolid>());
  EXPECT_EQ(message_of([&] { partner.ask(FluidTangent{}); }),
            "solid failed while answering FluidTangent: does not know FluidTangent");
}

TEST(Partner, An_unexpected_reply_names_both) {
  Partner partner(std::make_unique<LocalChannel>("fluid", pack(Hello{}), [](const Packet&) { return pack(Ready{}); }));
  partner.hello();
  EXPECT_EQ(message_of([&] { partner.ask(FluidTangent{}); }),
            "fluid while answering FluidTangent: replied Ready instead of Load");
}

TEST(Partner, A_refusing_partner_is_an_input_error) {
  Partner partner(std::make_unique<LocalChannel>("fluid", pack(Failure{"case.yaml:3: wrong", true}), nullptr));
  EXPECT_EQ(message_of([&] { partner.hello(); }), "fluid: case.yaml:3: wrong");
}

TEST(Serve, Lives_in_a_thread_until_it_is_stopped) {
  auto [master_end, partner_end] = thread_channel({"master"}, {"fluid"});
  std::thread thread([channel = std::move(partner_end)] {
    fakes::FakeFluid fluid;
    serve<ToFluid>(*channel, fluid.hello(), fluid);
  });
  Partner partner(std::move(master_end));
  EXPECT_EQ(partner.hello().program, "fake fluid 1");
  EXPECT_EQ(partner.ask(FluidTangent{std::vector<double>(54, 0.0)}).forces, std::vector<double>(54, 0.0));
  partner.stop("done");
  thread.join();
}

TEST(Serve, A_silent_peer_ends_the_wait) {
  auto [master_end, partner_end] = thread_channel({"master"}, {"fluid"});
  Partner partner(std::move(master_end));
  EXPECT_THROW(partner.hello(0.01), PeerSilent);
}

}  // namespace
}  // namespace tether::protocol
