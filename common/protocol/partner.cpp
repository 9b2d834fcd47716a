#include "common/protocol/partner.hpp"

namespace tether::protocol {

namespace {
constexpr double stop_limit = 2.0;  // seconds that an idle partner may take to finish when the master ends by an error
}

Partner::~Partner() {
  if (!channel_ || stage_ != Stage::idle) return;
  try {
    post(Stop::message_name, pack(Stop{"the master ends"}));
    take(stop_limit);
    channel_->close();
  } catch (const std::exception&) {
    // The partner is dead, silent or failing: Session::end sees that its channel was not closed and ends it.
  }
}

const Hello& Partner::hello(double limit) {
  if (stage_ != Stage::starting) return hello_;
  const Packet packet = take(limit);
  if (!holds<Hello>(packet)) {
    stage_ = Stage::over;
    channel_->close();
    reject(packet, Hello::message_name);
  }
  hello_ = unpack<Hello>(packet);
  return hello_;
}

void Partner::stop(const std::string& reason) {
  if (stage_ == Stage::starting) hello();
  post(Stop::message_name, pack(Stop{reason}));
  const Packet packet = take(infinite);
  stage_ = Stage::over;
  channel_->close();
  if (!holds<Ready>(packet)) reject(packet, Ready::message_name);
}

void Partner::post(const char* request_name, Packet packet) {
  TETHER_ASSERT(stage_ != Stage::starting, "{} was sent {} before its hello was read", role(), request_name);
  TETHER_ASSERT(stage_ == Stage::idle, "{} was sent {} while {}", role(), request_name, peer().activity);
  channel_->peer().activity = step_ < 0 ? fmt::format("answering {}", request_name)
                                        : fmt::format("computing step {} ({})", step_, request_name);
  stage_ = Stage::busy;
  channel_->send(std::move(packet));
}

Packet Partner::take(double limit) {
  TETHER_ASSERT(stage_ == Stage::starting || stage_ == Stage::busy, "{} was asked nothing", role());
  Packet packet;
  try {
    packet = channel_->receive(limit);
  } catch (const std::exception&) {
    stage_ = Stage::over;
    throw;
  }
  stage_ = Stage::idle;
  return packet;
}

void Partner::reject(const Packet& packet, const char* expected) const {
  if (!holds<Failure>(packet))
    throw run_error("{} while {}: replied {} instead of {}", peer().describe(), peer().activity,
                    kind_name<ToMaster>(packet.kind), expected);
  const auto failure = unpack<Failure>(packet);
  if (failure.input_wrong) throw InputError(fmt::format("{}: {}", role(), failure.message));
  throw PartnerFailed(fmt::format("{} failed while {}: {}", role(), peer().activity, failure.message));
}

}  // namespace tether::protocol
