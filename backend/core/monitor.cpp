#include "core/monitor.h"

#include "core/error.h"

namespace polycube {

void Monitor::check() const {
  if (cancelled_ || (cancel_requested && cancel_requested())) throw Cancelled("cancelled");
  if (Clock::now() > deadline_) throw Cancelled("out of time");
}

void Monitor::progress(const std::string& stage, double fraction) const {
  check();
  if (on_progress) on_progress(stage, fraction);
}

void Monitor::log(const std::string& line) const {
  if (on_log) on_log(line);
}

}  // namespace polycube
