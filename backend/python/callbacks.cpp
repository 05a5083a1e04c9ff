#include "python/bindings.h"

namespace polycube::python {
namespace {

/// True at most once per interval over all threads.
bool due(std::atomic<Monitor::Clock::rep>& next, std::chrono::milliseconds interval) {
  const auto now = Monitor::Clock::now();
  auto expected = next.load();
  if (now.time_since_epoch().count() < expected) return false;
  return next.compare_exchange_strong(expected, (now + interval).time_since_epoch().count());
}

}  // namespace

Callbacks::Callbacks(const py::object& progress, const py::object& log, const py::object& cancel) : progress_(progress), log_(log), cancel_(cancel) {
  monitor.cancel_requested = [this] { return cancel_requested(); };
  if (!progress_.is_none()) monitor.on_progress = [this](const std::string& stage, double fraction) { report(stage, fraction); };
  if (!log_.is_none()) monitor.on_log = [this](const std::string& line) { guarded([&] { log_(line); }); };
}

template <typename Work>
bool Callbacks::guarded(const Work& work) {
  const py::gil_scoped_acquire acquired;
  if (stop_) return false;
  try {
    work();
    return true;
  } catch (py::error_already_set& e) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_.emplace(e);
    stop_ = true;
    return false;
  }
}

bool Callbacks::cancel_requested() {
  if (stop_) return true;
  if (!due(next_cancel_, std::chrono::milliseconds(50))) return false;
  guarded([this] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!cancel_.is_none() && py::bool_(cancel_())) stop_ = true;
  });
  return stop_;
}

void Callbacks::report(const std::string& stage, double fraction) {
  // The start and the end of a stage always get through.
  if (fraction > 0 && fraction < 1 && !due(next_progress_, std::chrono::milliseconds(50))) return;
  guarded([&] { progress_(stage, fraction); });
}

void Callbacks::rethrow() {
  if (error_) throw py::error_already_set(*error_);
}

}  // namespace polycube::python
