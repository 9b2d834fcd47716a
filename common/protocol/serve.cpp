#include "common/protocol/serve.hpp"

namespace tether::protocol::detail {

Failure current_failure() {
  try {
    throw;
  } catch (const InputError& error) {
    return {error.what(), true};
  } catch (const std::exception& error) {
    return {error.what(), false};
  } catch (...) {
    return {"an exception of unknown type", false};
  }
}

}  // namespace tether::protocol::detail
