// Loops over fixed chunks, so that sums do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <functional>

namespace polycube {

/// Threads in force: as many as asked for, all cores for 0.
int thread_count(int asked);

/// Calls run(chunk) for every chunk of [0, chunks), on this thread and up to threads - 1 of TBB's, as far as there are cores. Returns when all are done. An
/// exception of a chunk is rethrown, and the chunks not begun by then are left out.
void share_chunks(int chunks, int threads, const std::function<void(int)>& run);

/// Calls body(chunk, first, last) for the chunks of [0, count); chunk limits depend on `size` alone. An exception of a body is rethrown.
template <class Body>
void for_chunks(int count, int size, int threads, const Body& body) {
  share_chunks((count + size - 1) / size, threads, [&](int c) { body(c, c * size, std::min(count, (c + 1) * size)); });
}

}  // namespace polycube
