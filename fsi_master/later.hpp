#pragma once

#include <exception>
#include <functional>
#include <utility>

namespace tether {

/// An answer that was asked for and is still to be received: ask both partners, then get both.
/// An answer nobody gets is received and dropped, so that the next request does not take it for its own.
template <class T>
class Later {
 public:
  explicit Later(std::function<T()> receive) : receive_(std::move(receive)) {}
  explicit Later(T value) : receive_([value = std::move(value)]() mutable { return std::move(value); }) {}
  Later(Later&& other) noexcept : receive_(std::exchange(other.receive_, nullptr)) {}
  Later& operator=(Later&&) = delete;
  ~Later() {
    if (!receive_) return;
    try {
      receive_();
    } catch (const std::exception&) {  // the first error is already on its way to the caller
    }
  }

  /// Waits. Once only. Throws what the partner's failure or death throws.
  T get() { return std::exchange(receive_, nullptr)(); }

 private:
  std::function<T()> receive_;
};

}  // namespace tether
