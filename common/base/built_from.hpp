#pragma once

namespace tether {

/// The commit of the sources as git describes it, with "-dirty" if they differ from it; empty without git. Written at
/// build time.
extern const char* const built_from;

}  // namespace tether
