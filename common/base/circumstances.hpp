#pragma once

namespace tether {

/// Throws RunError where limits of this process (open files, address space, stack, sizes of files) or a disk of TMPDIR
/// with less than so many MB leave too little to start programs under mpirun, which would tell of it in twenty lines of
/// its own, or never.
void check_circumstances(double free_mb);

}  // namespace tether
