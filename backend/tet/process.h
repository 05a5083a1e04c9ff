// One attempt in the worker process.
#pragma once

#include <string>
#include <vector>

#include "core/monitor.h"

namespace polycube {

/// Path of polycube-tet: POLYCUBE_TET_WORKER from the environment, else beside or above the running shared object or program, else in
/// libexec/polycube of the prefix that it is installed in. Throws std::runtime_error where there is none.
std::string find_worker();

/// Runs a program to its end. Returns an empty line if it ended with status 0, else what happened ("ran longer than 30 s", "died of signal
/// 11", its own words). Throws Cancelled when the monitor says so, StageFailed where it ended
/// with kCannotWrite; the program never outlives the call.
std::string run_worker(const std::vector<std::string>& command, const std::string& error_file, double seconds, const Monitor& monitor);

}  // namespace polycube
