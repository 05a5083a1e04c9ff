// Loops over fixed chunks, so that sums do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace polycube {

/// Calls body(chunk, first, last) for the chunks of [0, count); chunk limits depend on `size` alone. An exception of a body is rethrown.
template <class Body>
void for_chunks(int count, int size, int threads, const Body& body) {
  const int chunks = (count + size - 1) / size;
  const auto run = [&](int c) { body(c, c * size, std::min(count, (c + 1) * size)); };
  threads = std::min(threads, chunks);
  if (threads <= 1) {
    for (int c = 0; c < chunks; ++c) run(c);
    return;
  }
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto work = [&] {
    try {
      for (int c = next++; c < chunks; c = next++) run(c);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
      next = chunks;
    }
  };
  std::vector<std::thread> pool;
  for (int t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (auto& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace polycube
