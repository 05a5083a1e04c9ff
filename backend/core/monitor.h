// Progress, log and cancel in one argument that every stage takes.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

namespace polycube {

/// Passed by reference through all stages. Every loop longer than 0.1 s calls progress() or check().
/// Safe to use from several threads; the callbacks are called from the thread that reports.
class Monitor {
 public:
  using Clock = std::chrono::steady_clock;

  Monitor() = default;
  /// Reports where the other reports and is cancelled with it, but has a deadline of its own. Keeps a reference to it.
  Monitor(const Monitor& other, Clock::time_point deadline);
  /// From now on as if made from the other, with its deadline. Not while work runs.
  void follow(const Monitor& other);
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// Called with the stage's name and the fraction of that stage done, 0 to 1.
  std::function<void(const std::string& stage, double fraction)> on_progress;
  /// Called with one line of log, without line end.
  std::function<void(const std::string& line)> on_log;
  /// Asked at every check; true cancels. May be empty.
  std::function<bool()> cancel_requested;

  /// Work past this moment is cancelled.
  void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }
  Clock::time_point deadline() const { return deadline_; }
  /// Ask for a stop from any thread.
  void cancel() { cancelled_ = true; }

  /// Throws Cancelled if a stop was asked for, OutOfTime if the deadline has passed.
  void check() const;
  /// check(), then reports.
  void progress(const std::string& stage, double fraction) const;
  void log(const std::string& line) const;

 private:
  bool stop_asked() const { return cancelled_ || (cancel_requested && cancel_requested()); }
  std::atomic<bool> cancelled_{false};
  Clock::time_point deadline_ = Clock::time_point::max();
};

}  // namespace polycube
