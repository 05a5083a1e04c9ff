#include "core/parallel.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace polycube {
namespace {

struct Job {
  const std::function<void(int)>& run;  // alive until all chunks are done
  const int chunks;
  std::atomic<int> next{0};
  std::atomic<bool> failed{false};
  std::mutex guard;
  std::condition_variable finished;
  int done = 0;
  std::exception_ptr failure;

  void work() {
    for (int c = next++; c < chunks; c = next++) {
      std::exception_ptr thrown;
      try {
        if (!failed) run(c);
      } catch (...) {
        thrown = std::current_exception();
        failed = true;
      }
      const std::lock_guard lock(guard);
      if (!failure) failure = thrown;
      if (++done == chunks) finished.notify_all();
    }
  }
  void wait() {
    std::unique_lock lock(guard);
    finished.wait(lock, [this] { return done == chunks; });
    if (failure) std::rethrow_exception(failure);
  }
};

/// Threads that stay, to be there at once when there is work.
class Helpers {
 public:
  ~Helpers() {
    {
      const std::lock_guard lock(guard_);
      stop_ = true;
    }
    wake_.notify_all();
    for (std::thread& t : threads_) t.join();
  }
  void offer(const std::shared_ptr<Job>& job, int places) {
    const std::lock_guard lock(guard_);
    while (static_cast<int>(threads_.size()) < places) threads_.emplace_back([this] { serve(); });
    for (int i = 0; i < places; ++i) {
      offers_.push_back(job);
      wake_.notify_one();
    }
  }
  void withdraw(const std::shared_ptr<Job>& job) {
    const std::lock_guard lock(guard_);
    std::erase(offers_, job);
  }

 private:
  void serve() {
    std::unique_lock lock(guard_);
    for (;;) {
      wake_.wait(lock, [this] { return stop_ || !offers_.empty(); });
      if (stop_) return;
      const std::shared_ptr<Job> job = offers_.front();
      offers_.pop_front();
      lock.unlock();
      job->work();
      lock.lock();
    }
  }

  std::mutex guard_;
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Job>> offers_;
  std::vector<std::thread> threads_;
  bool stop_ = false;
};

}  // namespace

int thread_count(int asked) { return asked > 0 ? asked : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

void share_chunks(int chunks, int threads, const std::function<void(int)>& run) {
  threads = std::min(threads, chunks);
  if (threads <= 1) {
    for (int c = 0; c < chunks; ++c) run(c);
    return;
  }
  static Helpers helpers;
  const auto job = std::make_shared<Job>(run, chunks);
  helpers.offer(job, threads - 1);
  job->work();
  helpers.withdraw(job);
  job->wait();
}

}  // namespace polycube
