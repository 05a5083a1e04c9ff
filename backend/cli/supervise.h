// The engine in a process of its own: neither its crash nor a query that it is stuck in ever reaches the user.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "core/monitor.h"
#include "core/status.h"

namespace polycube {

/// A word that both processes see: the stage that the engine is in.
class StageNote {
 public:
  static constexpr std::size_t kLength = 32;
  void set(const std::string& stage);
  std::string get() const;

 private:
  std::array<std::atomic<char>, kLength> text_{};
};

struct Supervision {
  Monitor::Clock::time_point deadline = Monitor::Clock::time_point::max();
  std::vector<std::string> outputs;  ///< files that the work writes by way of a Draft
};

/// From now on SIGINT, SIGTERM and SIGHUP (but under nohup) are for supervise(), which it calls itself; a pipe that nobody reads ends nothing. Call it as early
/// as may be.
void watch_for_stops();

/// Runs the work in a child process and returns its exit status. A child that dies of a signal counts as failed (2): one line on standard
/// error names the stage and the signal. One that does not end by itself soon after the deadline or a signal that stops it, or gets a second one, is
/// killed and counts as stopped (3). Temporary files and drafts of a child that was killed are removed. Call it before any thread is
/// started.
int supervise(const std::function<int(StageNote&)>& work, const Supervision& supervision);

}  // namespace polycube
