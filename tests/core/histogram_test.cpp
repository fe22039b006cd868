#include "core/histogram.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace clay::falcon {
namespace {

/// Times of every magnitude, from 0 to the largest.
rc::Gen<std::int64_t> any_time() {
  return rc::gen::exec([] {
    const int bits = *rc::gen::inRange(0, 64);
    const auto any = *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>());
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    return static_cast<std::int64_t>(any & mask);
  });
}

Histogram histogram_of(const std::vector<std::int64_t>& times) {
  Histogram histogram;
  for (const std::int64_t time : times) histogram.add(time);
  return histogram;
}

RC_GTEST_PROP(Histogram, ReturnsQuantilesWithinItsError, ()) {
  auto times = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::int64_t>>(any_time()));
  const Histogram histogram = histogram_of(times);
  std::ranges::sort(times);
  RC_ASSERT(histogram.count() == times.size());
  RC_ASSERT(histogram.most_ns() == times.back());
  for (const double part : {0.0, 0.25, 0.5, 0.9, 0.99, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(times.size())));
    const std::int64_t true_ns = times[std::max<std::size_t>(rank, 1) - 1];
    const std::int64_t reported = histogram.quantile_ns(part);
    RC_ASSERT(reported >= true_ns);
    RC_ASSERT(static_cast<double>(reported - true_ns) <=
              Histogram::kRelativeError * static_cast<double>(true_ns));
    if (true_ns < 32) RC_ASSERT(reported == true_ns);
  }
}

RC_GTEST_PROP(Histogram, MeanIsExact, ()) {
  const auto times = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::int64_t>>(any_time()));
  double sum_ns = 0.0;
  for (const std::int64_t time : times) sum_ns += static_cast<double>(time);
  const double mean_ns = sum_ns / static_cast<double>(times.size());
  RC_ASSERT(std::abs(histogram_of(times).mean_ns() - mean_ns) <= 1e-12 * mean_ns);
}

TEST(Histogram, ReturnsMaximumOfExtremeTimes) {
  Histogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
  EXPECT_EQ(histogram.most_ns(), 0);
  EXPECT_EQ(histogram.mean_ns(), 0.0);
  histogram.add(-5);
  histogram.add(INT64_MAX);
  EXPECT_EQ(histogram.most_ns(), INT64_MAX);
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
  EXPECT_EQ(histogram.quantile_ns(1.0), INT64_MAX);
  for (const double part : {std::numeric_limits<double>::quiet_NaN(), -1.0})
    EXPECT_EQ(histogram.quantile_ns(part), 0);
  EXPECT_EQ(histogram.quantile_ns(2.0), INT64_MAX);
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0u);
}

TEST(Histogram, HasTheMeanOfItsTimes) {
  Histogram histogram;
  for (std::int64_t ns = 1; ns <= 1000; ++ns) histogram.add(ns * 1'000'000);
  EXPECT_EQ(histogram.mean_ns(), 500'500'000.0);
}

}  // namespace
}  // namespace clay::falcon
