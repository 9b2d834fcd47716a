#pragma once

/// How long processes wait for each other [s]. Environment variables change all of it.
namespace tether {

/// Throws InputError for one that is not a number above zero, which would count as unset.
void check_limits();

/// Until the program reaches MPI and arrives: TETHER_START_LIMIT, 60 if unset.
double start_limit();

/// From then until it has read its case and says hello: TETHER_SETUP_LIMIT, 600 if unset.
double setup_limit();

/// Between the wish that programs save their state and end, and the interruption of those that still work:
/// TETHER_END_LIMIT, 120 if unset.
double end_limit();

/// While a process is stopped by a signal: TETHER_STOPPED_LIMIT, 60 if unset.
double stopped_limit();

}  // namespace tether
