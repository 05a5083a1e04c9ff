#include "core/monitor.h"

#include "core/error.h"

namespace polycube {

Monitor::Monitor(const Monitor& other, Clock::time_point deadline) {
  follow(other);
  deadline_ = deadline;
}

void Monitor::follow(const Monitor& other) {
  on_progress = other.on_progress;
  on_log = other.on_log;
  cancel_requested = [&other] { return other.stop_asked(); };
  deadline_ = other.deadline_;
}

void Monitor::check() const {
  if (stop_asked()) throw Cancelled("cancelled");
  if (Clock::now() > deadline_) throw OutOfTime("out of time");
}

void Monitor::progress(const std::string& stage, double fraction) const {
  check();
  if (on_progress) on_progress(stage, fraction);
}

void Monitor::log(const std::string& line) const {
  if (on_log) on_log(line);
}

}  // namespace polycube
