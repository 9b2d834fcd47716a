#pragma once

/// How long a master waits for a partner before the first request [s]. Environment variables change both.
namespace tether::protocol {

/// Until the program reaches MPI and arrives: TETHER_START_LIMIT, 60 if unset.
double start_limit();

/// From then until it has read its case and says hello: TETHER_SETUP_LIMIT, 600 if unset.
double setup_limit();

}  // namespace tether::protocol
