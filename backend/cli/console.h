// What the user sees while the work goes on.
#pragma once

#include "core/monitor.h"

namespace polycube {

/// Sets the monitor up: a progress line on standard error where that is a terminal, a log with `verbose`, cancel by SIGINT and SIGTERM
/// (a second one ends the process at once).
class Console {
 public:
  Console(Monitor& monitor, bool verbose);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  /// Wipes the progress line.
  ~Console();

 private:
  void show(const std::string& stage, double fraction);
  void log(const std::string& line);
  void wipe();
  bool terminal_, verbose_, shown_ = false;
  Monitor::Clock::time_point start_, last_;
};

}  // namespace polycube
