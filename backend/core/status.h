// How the programs end.
#pragma once

namespace polycube {

/// Exit status: done, InvalidInput, StageFailed, Cancelled (core/error.h).
enum Status { kDone = 0, kBadInput = 1, kFailed = 2, kStopped = 3 };

}  // namespace polycube
