// Seconds per stage, summed over all that a run tries.
#pragma once

#include <string>
#include <vector>

#include "core/monitor.h"
#include "core/report.h"

namespace polycube {

class StageClock {
 public:
  /// Keeps a reference to the monitor.
  explicit StageClock(const Monitor& monitor) : monitor_(monitor) {}
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

  /// Does the work as part of the stage, whether it throws or not.
  template <class Work>
  decltype(auto) stage(const std::string& name, Work work) {
    monitor_.progress(name, 0);
    const auto start = Monitor::Clock::now();
    struct Book {
      StageClock* clock;
      const std::string& name;
      Monitor::Clock::time_point start;
      ~Book() { clock->book(name, std::chrono::duration<double>(Monitor::Clock::now() - start).count()); }
    } book{this, name, start};
    return work();
  }
  void restart() { records_.clear(); }
  const std::vector<StageRecord>& records() const { return records_; }

 private:
  void book(const std::string& name, double seconds) {
    for (StageRecord& s : records_) {
      if (s.name == name) {
        s.seconds += seconds;
        return;
      }
    }
    records_.push_back({name, seconds});
  }

  const Monitor& monitor_;
  std::vector<StageRecord> records_;
};

}  // namespace polycube
