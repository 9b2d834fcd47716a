#include <algorithm>
#include <optional>

#include "client/tether.h"
#include "common/protocol/fellows.hpp"
#include "common/protocol/launch.hpp"
#include "common/protocol/serve.hpp"

/// The C interface: plain structs in and out, the protocol's own code between.
namespace tether::protocol {
namespace {

template <class Message>
constexpr int kind = kind_of<Message, ToPartner>;
static_assert(TETHER_SET_PARAMETERS == kind<SetParameters> && TETHER_GET_STATE == kind<GetState> &&
              TETHER_SET_STATE == kind<SetState> && TETHER_BEGIN_STEP == kind<BeginStep> &&
              TETHER_END_STEP == kind<EndStep> && TETHER_WRITE == kind<Write> &&
              TETHER_FLUID_EVALUATE == kind<FluidEvaluate> && TETHER_FLUID_TANGENT == kind<FluidTangent> &&
              TETHER_SOLID_EVALUATE == kind<SolidEvaluate> && TETHER_SOLID_TANGENT == kind<SolidTangent> &&
              TETHER_SOLID_RESIDUAL == kind<SolidResidual> && TETHER_SOLID_PRODUCT == kind<SolidProduct> &&
              TETHER_SOLID_PRECONDITION == kind<SolidPrecondition> && TETHER_OBSERVE == kind<Observe> &&
              TETHER_GET_VELOCITY == kind<GetVelocity>);
static_assert(TETHER_NO_COMMUNICATOR == no_communicator && TETHER_ALL_PROCESSES == all_processes);

thread_local std::string last_error;

/// The value of `body`, or `otherwise` if it throws.
template <class Value, class Body>
Value guarded(Value otherwise, Body body) {
  try {
    return body();
  } catch (const std::exception& error) {
    last_error = error.what();
    return otherwise;
  }
}

std::string text(const char* characters) {
  return characters ? characters : "";
}

template <class Value>
std::vector<Value> array(const Value* first, std::int64_t count) {
  return first ? std::vector<Value>(first, first + count) : std::vector<Value>{};
}

Hello hello_of(const tether_description& d) {
  Hello hello{text(d.program),
              d.has_tangent != 0,
              d.has_operators != 0,
              d.has_state != 0,
              false,
              d.has_velocity != 0,
              d.state_size,
              d.unknowns,
              {},
              {},
              text(d.effective_case),
              {}};
  for (const auto& p : array(d.parameters, d.parameter_count))
    hello.parameters.push_back({text(p.name), text(p.meaning), text(p.unit), text(p.transform), p.value, p.absent,
                                p.lower, p.upper, p.prior_deviation, p.scale});
  for (const auto& o : array(d.observables, d.observable_count))
    hello.observables.push_back({text(o.name), text(o.unit)});
  return hello;
}

Interface interface_of(const tether_description& d) {
  Interface surface{array(d.points, 3 * d.node_count), array(d.triangles, 3 * d.triangle_count), {}, {}};
  for (const char* name : array(d.region_names, d.region_count)) surface.region_names.push_back(text(name));
  surface.regions = array(d.regions, d.triangle_count);
  return surface;
}

tether_array view(const std::vector<double>& values) {
  return {values.data(), static_cast<std::int64_t>(values.size())};
}

/// Fills the request's fields from a message; the views point into it.
struct Fill {
  tether_request& request;
  std::vector<const char*>& names;

  void operator()(const SetParameters& m) const {
    for (const auto& name : m.names) names.push_back(name.c_str());
    request.names = names.data();
    request.values = view(m.values);
  }
  void operator()(const SetState& m) const { request.values = view(m.values); }
  void operator()(const BeginStep& m) const {
    request.step = m.step;
    request.time = m.time;
    request.dt = m.dt;
    request.displacement = view(m.predicted);
  }
  void operator()(const EndStep& m) const { request.accepted = m.accepted ? 1 : 0; }
  void operator()(const Write& m) const {
    request.step = m.step;
    request.time = m.time;
  }
  void operator()(const FluidEvaluate& m) const {
    request.displacement = view(m.displacement);
    request.velocity = view(m.velocity);
  }
  void operator()(const FluidTangent& m) const { request.velocity = view(m.velocity_change); }
  void operator()(const SolidEvaluate& m) const { request.load = view(m.load); }
  void operator()(const SolidTangent& m) const { request.load = view(m.load_change); }
  void operator()(const SolidResidual& m) const {
    request.values = view(m.correction);
    request.load = view(m.load);
  }
  void operator()(const SolidProduct& m) const { request.values = view(m.direction); }
  void operator()(const SolidPrecondition& m) const { request.values = view(m.residual); }
  void operator()(const Observe& m) const {
    request.time = m.time;
    request.values = view(m.points);
  }
  void operator()(const GetVelocity& m) const { request.values = view(m.points); }
  template <class Other>
  void operator()(const Other&) const {}
};

/// Takes the fields of a reply from arrays.
struct FromArrays {
  const tether_array* arrays;
  template <class... Fields>
  void operator()(Fields&... fields) {
    (take(fields), ...);
  }
  template <class Number>
  void take(std::vector<Number>& field) {
    const std::vector<double> values = array(arrays->data, arrays->size);
    field.assign(values.begin(), values.end());
    ++arrays;
  }
};

/// Counts the fields of a message.
struct Count {
  int fields = 0;
  template <class... Fields>
  void operator()(const Fields&...) {
    fields = sizeof...(Fields);
  }
};

template <class Reply, class... Others>
inline constexpr bool is_any_of = (std::is_same_v<Reply, Others> || ...);

/// Not of those that the library sends itself, nor of those of Tether's own masters.
template <class Reply>
Packet reply_from(const tether_array* arrays, int count) {
  if constexpr (is_any_of<Reply, Interface, Usage, Advanced, Simulated, RunEnded>) {
    throw InternalError("no foreign code answers this");
  } else {
    Reply reply;
    Count expected;
    reply.fields(expected);
    if (count != expected.fields)
      throw run_error("a reply {} has {} arrays, not {}", Reply::message_name, expected.fields, count);
    FromArrays archive{arrays};
    reply.fields(archive);
    return pack(reply);
  }
}

/// Throws InputError if an array of a request does not fit the partner.
struct CheckSizes {
  const Hello& hello;
  std::size_t interface;  ///< three per node

  void operator()(const SetState& m) const { require("state", m.values, static_cast<std::size_t>(hello.state_size)); }
  void operator()(const BeginStep& m) const { require("predicted displacement", m.predicted, interface); }
  void operator()(const FluidEvaluate& m) const {
    require("displacement", m.displacement, interface);
    require("velocity", m.velocity, interface);
  }
  void operator()(const FluidTangent& m) const { require("velocity change", m.velocity_change, interface); }
  void operator()(const SolidEvaluate& m) const { require("load", m.load, interface); }
  void operator()(const SolidTangent& m) const { require("load change", m.load_change, interface); }
  void operator()(const SolidResidual& m) const {
    if (!m.correction.empty()) require("correction", m.correction, static_cast<std::size_t>(hello.unknowns));
    require("load", m.load, interface);
  }
  void operator()(const SolidProduct& m) const {
    require("direction", m.direction, static_cast<std::size_t>(hello.unknowns));
  }
  void operator()(const SolidPrecondition& m) const {
    require("residual", m.residual, static_cast<std::size_t>(hello.unknowns));
  }
  void operator()(const GetVelocity& m) const {
    if (m.points.size() % 3 != 0) throw input_error("{} numbers are not three a point", m.points.size());
  }
  void operator()(const SetParameters& m) const {
    require("parameter values", m.values, m.names.size());
    for (const auto& name : m.names)
      if (std::none_of(hello.parameters.begin(), hello.parameters.end(), [&](const auto& p) { return p.name == name; }))
        throw input_error("{} has no parameter {}", hello.program, name);
  }
  template <class Other>
  void operator()(const Other&) const {}

  static void require(const char* what, const std::vector<double>& values, std::size_t size) {
    if (values.size() != size) throw input_error("the {} has {} numbers instead of {}", what, values.size(), size);
  }
};

/// Whether a role has to do with a request; a role that is not ours gets them all.
bool concerns(const std::string& role, const Packet& packet) {
  const auto in = [&packet]<class... Requests>(std::variant<Requests...>*) { return (holds<Requests>(packet) || ...); };
  if (role == "fluid") return in(static_cast<ToFluid*>(nullptr)) || holds<GetVelocity>(packet);
  if (role == "solid") return in(static_cast<ToSolid*>(nullptr));
  return true;
}

template <class Request>
concept HasReply = requires {
  typename Request::Reply;
};

}  // namespace

/// One partner as the C interface sees it.
class Client {
 public:
  Client(const std::string& role, int communicator) : role_(role), session_(role, communicator) {
    if (!session_.is_alone()) fellows_.emplace(role, session_.communicator());
    if (session_.is_leader()) link_ = session_.connect();
  }

  bool is_leader() const { return session_.is_leader(); }
  int communicator() const { return session_.communicator(); }
  const char* output() const { return link_ ? link_->welcome.output.c_str() : ""; }

  void introduce(const tether_description& description) {
    hello_ = hello_of(description);
    surface_ = interface_of(description);
    master().send(pack(hello_));
  }

  void refuse(const std::string& message) {
    master().send(pack(Failure{message, true}));
    stage_ = Stage::over;
    if (session_.is_alone()) master().close(exit_run_failed);  // else in `end`, where the others take leave too
  }

  bool next(tether_request& request) {
    if (stage_ == Stage::asked) fail("the program did not reply", false);
    while (stage_ == Stage::free) {
      const Packet packet = master().receive();
      try {
        take(packet);
      } catch (const std::exception&) {
        master().send(pack(detail::current_failure()));
      }
    }
    if (stage_ != Stage::asked) return false;
    names_.clear();
    request = {};
    request.kind = static_cast<int>(message_.index());
    std::visit(Fill{request, names_}, message_);
    return true;
  }

  void reply(const tether_array* arrays, int count) {
    require_question();
    const Packet packet = std::visit(
        [&]<class Request>(const Request&) -> Packet {
          if constexpr (HasReply<Request>)
            return reply_from<typename Request::Reply>(arrays, count);
          else
            throw InternalError("no request");
        },
        message_);
    stage_ = Stage::free;
    master().send(packet);
  }

  void fail(const std::string& message, bool input_wrong) {
    require_question();
    stage_ = Stage::free;
    master().send(pack(Failure{message, input_wrong}));
  }

  int end() {
    if (fellows_) fellows_->part();
    if (stage_ == Stage::stopping) {
      master().send(pack(Ready{}));
      if (std::get<Stop>(message_).abrupt) {
        master().flush();
      } else {
        session_.gather_processes();
        master().close(exit_done);
      }
    }
    if (stage_ == Stage::over && !session_.is_alone()) {
      session_.gather_processes();
      master().close(exit_run_failed);
    }
    link_.reset();
    return session_.end(exit_done);
  }

 private:
  enum class Stage { free, asked, stopping, over };

  Channel& master() {
    if (!link_) throw run_error("only the leader (rank 0) talks to the master");
    return *link_->channel;
  }
  void require_question() const {
    if (stage_ != Stage::asked) throw run_error("there is no request to reply to");
  }

  /// Answers what needs no help from the program; keeps everything else for it.
  void take(const Packet& packet) {
    message_ = unpack_any<ToPartner>(packet);
    if (holds<GetUsage>(packet)) return master().send(pack(Usage{cpu_seconds(), peak_memory_mb()}));
    if (holds<GetInterface>(packet)) return master().send(pack(surface_));
    if (!concerns(role_, packet)) throw run_error("does not know {}", kind_name<ToPartner>(packet.kind));
    std::visit(CheckSizes{hello_, surface_.points.size()}, message_);
    stage_ = holds<Stop>(packet) ? Stage::stopping : Stage::asked;
  }

  std::string role_;
  Session session_;
  std::optional<Fellows> fellows_;  ///< where this code has several processes
  std::optional<Session::Link> link_;
  Stage stage_ = Stage::free;
  Hello hello_;
  Interface surface_;
  ToPartner message_;
  std::vector<const char*> names_;
};

}  // namespace tether::protocol

struct tether_partner {
  tether::protocol::Client client;
};

using tether::protocol::guarded;

tether_partner* tether_connect(const char* role, int communicator) {
  return guarded<tether_partner*>(nullptr, [&] { return new tether_partner{{role, communicator}}; });
}

int tether_communicator(const tether_partner* partner) {
  return partner->client.communicator();
}

int tether_is_leader(const tether_partner* partner) {
  return partner->client.is_leader() ? 1 : 0;
}

const char* tether_output(const tether_partner* partner) {
  return partner->client.output();
}

int tether_introduce(tether_partner* partner, const tether_description* description) {
  return guarded(-1, [&] { return partner->client.introduce(*description), 0; });
}

int tether_refuse(tether_partner* partner, const char* message) {
  return guarded(-1, [&] { return partner->client.refuse(message), 0; });
}

int tether_next(tether_partner* partner, tether_request* request) {
  return guarded(-1, [&] { return partner->client.next(*request) ? 1 : 0; });
}

int tether_reply(tether_partner* partner, const tether_array* arrays, int count) {
  return guarded(-1, [&] { return partner->client.reply(arrays, count), 0; });
}

int tether_fail(tether_partner* partner, const char* message) {
  return guarded(-1, [&] { return partner->client.fail(message, false), 0; });
}

int tether_end(tether_partner* partner) {
  const int code = guarded(static_cast<int>(tether::exit_run_failed), [&] { return partner->client.end(); });
  delete partner;
  return code;
}

const char* tether_error(void) {
  return tether::protocol::last_error.c_str();
}
