#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/base/error.hpp"
#include "common/protocol/messages.hpp"

/// Messages as bytes. In the order of `fields`: int64 and double as they are (little-endian), a bool as int64 0 or 1,
/// a string as int64 length + bytes, a vector as int64 count + elements.
namespace tether::protocol {

static_assert(std::endian::native == std::endian::little, "the wire format is little-endian");

using Bytes = std::vector<std::byte>;

/// A message on its way: its index in ToPartner or ToMaster, and its fields.
struct Packet {
  int kind = 0;
  Bytes bytes;
};

/// A packet that is not what it says: cut short, too long, of an unknown kind.
struct MalformedMessage : RunError {
  using RunError::RunError;
};

/// MPI counts bytes in a 32-bit int.
inline constexpr std::size_t largest_message = (std::size_t{1} << 31) - 1;

/// Throws RunError naming the message if it is too large to be sent.
void check_message_size(const char* message_name, std::size_t bytes);

/// Archive that appends fields to bytes.
class Writer {
 public:
  template <class... Fields>
  void operator()(const Fields&... fields) {
    (write(fields), ...);
  }
  Bytes take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  void write(std::int64_t value) { raw(&value, sizeof value); }
  void write(double value) { raw(&value, sizeof value); }
  void write(bool value) { write(std::int64_t{value}); }
  void write(const std::string& text) {
    write(static_cast<std::int64_t>(text.size()));
    raw(text.data(), text.size());
  }
  template <class Element>
  void write(const std::vector<Element>& elements) {
    write(static_cast<std::int64_t>(elements.size()));
    if constexpr (std::is_arithmetic_v<Element>) {
      raw(elements.data(), elements.size() * sizeof(Element));
    } else {
      for (const Element& element : elements) write(element);
    }
  }
  template <class Struct>
  requires requires(const Struct& s, Writer& w) { s.fields(w); }
  void write(const Struct& value) { value.fields(*this); }

  Bytes bytes_;
};

/// Archive that takes fields from bytes. Throws MalformedMessage where they do not suffice.
class Reader {
 public:
  Reader(const char* message_name, std::span<const std::byte> bytes) : message_name_(message_name), rest_(bytes) {}
  template <class... Fields>
  void operator()(Fields&... fields) {
    (read(fields), ...);
  }
  /// Throws MalformedMessage if bytes are left over.
  void expect_end() const;

 private:
  void raw(void* data, std::size_t size);
  std::size_t count(std::size_t smallest_element);
  void read(std::int64_t& value) { raw(&value, sizeof value); }
  void read(double& value) { raw(&value, sizeof value); }
  void read(bool& value);
  void read(std::string& text);
  template <class Element>
  void read(std::vector<Element>& elements) {
    elements.resize(count(8));  // every kind of field takes at least 8 bytes
    if constexpr (std::is_arithmetic_v<Element>) {
      raw(elements.data(), elements.size() * sizeof(Element));
    } else {
      for (Element& element : elements) read(element);
    }
  }
  template <class Struct>
  requires requires(Struct& s, Reader& r) { s.fields(r); }
  void read(Struct& value) { value.fields(*this); }

  const char* message_name_;
  std::span<const std::byte> rest_;
};

/// Index of `Message` in `Direction` (ToPartner, ToMaster); the variant's size if it is not one of them.
template <class Message, class Direction>
inline constexpr int kind_of = 0;
template <class Message, class... Messages>
inline constexpr int kind_of<Message, std::variant<Messages...>> = [] {
  int kind = 0;
  static_cast<void>(((std::same_as<Message, Messages> || (++kind, false)) || ...));
  return kind;
}();

template <class Message>
using DirectionOf = std::conditional_t<(kind_of<Message, ToPartner> < static_cast<int>(std::variant_size_v<ToPartner>)),
                                       ToPartner, ToMaster>;

template <class Message>
Packet pack(const Message& message) {
  using Direction = DirectionOf<Message>;
  constexpr int kind = kind_of<Message, Direction>;
  static_assert(kind < static_cast<int>(std::variant_size_v<Direction>), "not a message");
  Writer writer;
  message.fields(writer);
  Packet packet{kind, writer.take()};
  check_message_size(Message::message_name, packet.bytes.size());
  return packet;
}

template <class Message>
bool holds(const Packet& packet) {
  return packet.kind == kind_of<Message, DirectionOf<Message>>;
}

/// The message in a packet that holds one. Throws MalformedMessage.
template <class Message>
Message unpack(const Packet& packet) {
  TETHER_ASSERT(holds<Message>(packet), "a packet of kind {} is no {}", packet.kind, Message::message_name);
  Reader reader(Message::message_name, packet.bytes);
  Message message;
  message.fields(reader);
  reader.expect_end();
  return message;
}

/// The message in a packet of that direction, whichever it is. Throws MalformedMessage.
template <class Direction>
Direction unpack_any(const Packet& packet) {
  return [&packet]<class... Messages>(std::variant<Messages...>*) {
    Direction message;
    if (!((holds<Messages>(packet) && (message = unpack<Messages>(packet), true)) || ...))
      throw MalformedMessage(fmt::format("there is no message of kind {}", packet.kind));
    return message;
  }(static_cast<Direction*>(nullptr));
}

/// "Load", or "kind 77" for a number that is no message of that direction.
template <class Direction>
std::string kind_name(int kind) {
  return [kind]<class... Messages>(std::variant<Messages...>*) {
    std::string name = fmt::format("kind {}", kind);
    static_cast<void>(((kind == kind_of<Messages, Direction> && (name = Messages::message_name, true)) || ...));
    return name;
  }(static_cast<Direction*>(nullptr));
}

}  // namespace tether::protocol
