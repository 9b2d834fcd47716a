#pragma once

namespace tether {

/// The program `tether VERB CASE.yaml [options]`: one verb per thing that a person wants done with a case. Returns the
/// exit code.
int front_end(int argc, char** argv);

}  // namespace tether
