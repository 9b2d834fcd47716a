#include "common/protocol/partner.hpp"

namespace tether::protocol {

const Hello& Partner::hello(double limit) {
  if (stage_ != Stage::starting) return hello_;
  Packet packet;
  try {
    packet = take(limit);
  } catch (const PeerSilent&) {
    throw PeerSilent(peer(), limit, " (TETHER_SETUP_LIMIT=SECONDS lets it take longer)");
  }
  if (!holds<Hello>(packet)) {
    close(exit_run_failed);
    reject(packet, Hello::message_name);
  }
  hello_ = unpack<Hello>(packet);
  return hello_;
}

void Partner::finish(const Stop& stop, double limit) {
  post(Stop::message_name, pack(stop));
  const Packet packet = take(limit);
  stage_ = Stage::finished;
  if (!holds<Ready>(packet)) reject(packet, Ready::message_name);
}

void Partner::close(int exit_code) {
  if (stage_ == Stage::closed) return;
  channel_->close(exit_code);
  stage_ = Stage::closed;
}

void Partner::stop(const std::string& reason) {
  finish({reason});
  close(exit_done);
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
    stage_ = Stage::lost;
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
  throw PartnerFailed(peer().failure(failure.message));
}

}  // namespace tether::protocol
