// What happens at a segmentation fault and its like.
#pragma once

namespace polycube {

/// Faults end this process as the system has it. Libraries put handlers there that print a stack of their own: UCX does, which comes with MPI and HDF5.
void end_by_faults();

}  // namespace polycube
