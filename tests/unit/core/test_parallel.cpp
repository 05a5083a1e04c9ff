#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "core/parallel.h"

namespace polycube {
namespace {

TEST(Parallel, EveryElementIsVisitedOnceInFixedChunks) {
  for (int threads : {0, 1, 2, 5}) {
    for (int count : {0, 1, 7, 64, 1000}) {
      std::vector<int> visits(static_cast<std::size_t>(count), 0), chunk(visits.size(), -1);
      for_chunks(count, 7, threads, [&](int c, int first, int last) {
        for (int i = first; i < last; ++i) {
          ++visits[i];
          chunk[i] = c;
        }
      });
      for (int i = 0; i < count; ++i) {
        EXPECT_EQ(visits[i], 1);
        EXPECT_EQ(chunk[i], i / 7);
      }
    }
  }
}

TEST(Parallel, LoopsInsideLoopsComeToAnEnd) {
  std::atomic<int> sum{0};
  for_chunks(20, 1, 4, [&](int, int first, int) { for_chunks(10, 1, 4, [&](int, int inner, int) { sum += first * inner; }); });
  EXPECT_EQ(sum, 190 * 45);
}

TEST(Parallel, AnExceptionArrivesAndTheNextLoopWorks) {
  for (int threads : {1, 3}) {
    const auto fail = [&] {
      for_chunks(100, 1, threads, [](int c, int, int) {
        if (c == 40) throw std::runtime_error("forty");
      });
    };
    EXPECT_THROW(fail(), std::runtime_error);
    std::atomic<int> calls{0};
    for_chunks(100, 1, threads, [&](int, int, int) { ++calls; });
    EXPECT_EQ(calls, 100);
  }
}

}  // namespace
}  // namespace polycube
