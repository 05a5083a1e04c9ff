#include "core/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <map>
#include <mutex>
#include <thread>

namespace polycube {
namespace {

/// Threads that work together, by their number; they stay, for to begin anew takes longer than many a loop. For more than there are cores TBB writes a warning
/// on standard error.
tbb::task_arena& arena_of(int threads) {
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> arenas;
  const std::lock_guard lock(mutex);
  const int count = std::min(threads, tbb::info::default_concurrency());
  return arenas.try_emplace(count, count).first->second;
}

}  // namespace

int thread_count(int asked) { return asked > 0 ? asked : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

void share_chunks(int chunks, int threads, const std::function<void(int)>& run) {
  threads = std::min(threads, chunks);
  if (threads <= 1) {
    for (int c = 0; c < chunks; ++c) run(c);
    return;
  }
  // Isolated: a thread that waits for the chunks of a loop inside another takes none of the outer loop's meanwhile.
  arena_of(threads).execute([&] { tbb::this_task_arena::isolate([&] { tbb::parallel_for(0, chunks, run, tbb::simple_partitioner()); }); });
}

}  // namespace polycube
