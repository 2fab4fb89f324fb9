#include "thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <vector>

namespace cfem_cutting {
namespace {

class Threads : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(1, 2, 3, 8));  // also more than there are cores

TEST_P(Threads, DoEachIndexOnce) {
  ThreadPool pool(GetParam());
  for (int count = 0; count < 300; ++count) {
    for (const int grain : {1, 7, 100}) {
      std::vector<std::atomic<int>> done(count);
      pool.for_range(count, grain, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) ++done[i];
      });
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST_P(Threads, TakeAtLeastAGrainAtOnce) {
  ThreadPool pool(GetParam());
  std::atomic<int> smallest{1000};
  pool.for_range(1000, 30, [&](int begin, int end) {
    for (int seen = smallest; end - begin < seen && !smallest.compare_exchange_weak(seen, end - begin);)
      continue;
  });
  EXPECT_GE(smallest, 30);
}

TEST_P(Threads, SeeWhatRoundsBeforeWrote) {
  ThreadPool pool(GetParam());
  std::vector<int> values(64, 0);
  for (int round = 1; round <= 20000; ++round)
    pool.for_range(64, 1, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) values[i] = values[i] + 1;
    });
  for (int value : values) EXPECT_EQ(value, 20000);
}

#if defined(__SSE2__)
TEST_P(Threads, TakeSubnormalNumbersForZeroInTheWorkAlone) {
  ThreadPool pool(GetParam());
  const volatile float small = std::numeric_limits<float>::min();
  std::vector<float> halves(64, 1.0f);
  pool.for_range(64, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) halves[i] = 0.5f * small;
  });
  for (float half : halves) EXPECT_EQ(half, 0.0f);
  EXPECT_GT(0.5f * small, 0.0f);
}
#endif

}  // namespace
}  // namespace cfem_cutting
