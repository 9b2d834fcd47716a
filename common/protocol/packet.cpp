#include "common/protocol/packet.hpp"

namespace tether::protocol {

void check_message_size(const char* message_name, std::size_t bytes) {
  if (bytes > largest_message)
    throw run_error("a {} of {} bytes cannot be sent: the limit is {} bytes", message_name, bytes, largest_message);
}

void Reader::expect_end() const {
  if (!rest_.empty()) throw MalformedMessage(fmt::format("{}: {} bytes too many", message_name_, rest_.size()));
}

void Reader::raw(void* data, std::size_t size) {
  if (size > rest_.size())
    throw MalformedMessage(fmt::format("{}: a field needs {} bytes, {} are left", message_name_, size, rest_.size()));
  if (size > 0) std::memcpy(data, rest_.data(), size);
  rest_ = rest_.subspan(size);
}

std::size_t Reader::count(std::size_t smallest_element) {
  std::int64_t count = 0;
  read(count);
  if (count < 0 || static_cast<std::size_t>(count) > rest_.size() / smallest_element)
    throw MalformedMessage(
        fmt::format("{}: a field announces {} elements, {} bytes are left", message_name_, count, rest_.size()));
  return static_cast<std::size_t>(count);
}

void Reader::read(bool& value) {
  std::int64_t number = 0;
  read(number);
  if (number != 0 && number != 1) throw MalformedMessage(fmt::format("{}: a bool is {}", message_name_, number));
  value = number == 1;
}

void Reader::read(std::string& text) {
  text.resize(count(1));
  raw(text.data(), text.size());
}

}  // namespace tether::protocol
