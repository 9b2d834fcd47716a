#pragma once

/// Which sanitizer the tests are compiled with: GCC tells by macros, Clang by features.

#if defined(__has_feature)
#define TETHER_HAS_FEATURE(name) __has_feature(name)
#else
#define TETHER_HAS_FEATURE(name) 0
#endif

namespace tether {

#if defined(__SANITIZE_ADDRESS__) || TETHER_HAS_FEATURE(address_sanitizer)
constexpr bool with_address_sanitizer = true;
#else
constexpr bool with_address_sanitizer = false;
#endif

#if defined(__SANITIZE_THREAD__) || TETHER_HAS_FEATURE(thread_sanitizer)
constexpr bool with_thread_sanitizer = true;
#else
constexpr bool with_thread_sanitizer = false;
#endif

}  // namespace tether

#undef TETHER_HAS_FEATURE
