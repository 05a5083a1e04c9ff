// What the user sees while the work goes on.
#pragma once

#include "cli/supervise.h"
#include "core/monitor.h"

namespace polycube {

/// Sets the monitor up: a progress line on standard error where that is a terminal, a log with `verbose`, cancel by SIGINT and SIGTERM, the
/// stage noted for whoever watches over this process.
class Console {
 public:
  Console(Monitor& monitor, StageNote& note, bool verbose);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  /// Wipes the progress line.
  ~Console();

 private:
  void progress(const std::string& stage, double fraction);
  void show(const std::string& stage, double fraction);
  void log(const std::string& line);
  void wipe();
  StageNote& note_;
  bool terminal_, verbose_, shown_ = false;
  Monitor::Clock::time_point start_, last_;
};

}  // namespace polycube
