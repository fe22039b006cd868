#include "engine/tick/rayleigh_kernel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace clay {
namespace {

/// P_d(1) .. P_d(L1).
std::vector<double> weights_of(const RayleighKernel& kernel) {
  std::vector<double> weights;
  RayleighKernel::ShareCursor cursor(kernel);
  std::int64_t before = 0;
  for (std::size_t j = 1; j <= kernel.length(); ++j) {
    const std::int64_t part = cursor.next();
    weights.push_back(0x1p-40 * static_cast<double>(part - before));
    before = part;
  }
  return weights;
}

TEST(RayleighKernel, WeightsMatchThePaper) {
  const double sigma = 8.0, h = 0.75;
  const RayleighKernel kernel(sigma, 30.0, h, 1000);
  ASSERT_EQ(kernel.length(), 40u);
  const auto q = [&](double x) {
    return x / (sigma * sigma) * std::exp(-x * x / (2 * sigma * sigma));
  };
  const std::vector<double> weights = weights_of(kernel);
  double sum = 0.0;
  for (std::size_t k = 1; k <= 40; ++k) sum += q(h * static_cast<double>(k));
  for (std::size_t j = 1; j <= 40; ++j)
    EXPECT_NEAR(weights[j - 1], q(h * static_cast<double>(j)) / sum, 1e-11);
}

RC_GTEST_PROP(RayleighKernel, SharesAddUpToTheAmount, ()) {
  const double sigma = *rc::gen::element(0.0, 1e-3, 0.3, 5.0, 80.0, 1e200);
  const double reach = *rc::gen::element(0.6, 3.0, 40.0, 500.0);
  const RayleighKernel kernel(sigma, reach, 0.5, 4000);
  const WideQuanta amount = WideQuanta{*rc::gen::inRange<Quanta>(0, Quanta{1} << 61)}
                            << *rc::gen::inRange(0, 24);  // up to 2^24 rings of 2^61
  RayleighKernel::ShareCursor cursor(kernel);
  RayleighKernel::Shares shares(amount);
  WideQuanta sum = 0;
  for (std::size_t j = 1; j <= kernel.length(); ++j) {
    const WideQuanta share = shares.next(cursor.next());
    RC_ASSERT(share >= 0);
    sum += share;
  }
  RC_ASSERT(sum == amount);
}

TEST(RayleighKernel, IsZeroBeyondTheEffectiveLength) {
  for (const double sigma : {0.0, 1.0, 3.0, 50.0, 1e200}) {
    const RayleighKernel kernel(sigma, 200.0, 1.0, 1000);
    ASSERT_EQ(kernel.length(), 200u);
    const std::size_t length = kernel.effective_length();
    const std::vector<double> weights = weights_of(kernel);
    EXPECT_GT(weights[length - 1], 0.0) << sigma;
    for (std::size_t j = length + 1; j <= 200; ++j) EXPECT_EQ(weights[j - 1], 0.0) << sigma;
  }
  EXPECT_EQ(RayleighKernel(8.0, 0.0, 1.0, 100).effective_length(), 0u);
  // e^(-x^2 / 2 sigma^2) is 2^-41 at x = 7.54 sigma.
  EXPECT_NEAR(static_cast<double>(RayleighKernel(100.0, 1e300, 1.0, 100'000).effective_length()),
              753.9, 1.0);
}

TEST(RayleighKernel, LimitsOfSigmaAreDefined) {
  for (const double sigma : {0.0, 1e-160, 1e-3}) {
    const RayleighKernel narrow(sigma, 10.0, 1.0, 100);
    EXPECT_EQ(
        RayleighKernel::Shares<Quanta>(12345).next(RayleighKernel::ShareCursor(narrow).next()),
        12345)
        << sigma;
  }
  for (const double sigma : {1e155, 1e300, std::numeric_limits<double>::infinity()}) {
    const RayleighKernel wide(sigma, 4.0, 1.0, 100);  // weights 1:2:3:4
    const std::vector<double> weights = weights_of(wide);
    for (std::size_t j = 1; j <= 4; ++j)
      EXPECT_NEAR(weights[j - 1], 0.1 * static_cast<double>(j), 1e-11) << sigma;
  }
}

TEST(RayleighKernel, LimitsOfReachAreDefined) {
  EXPECT_EQ(RayleighKernel(8.0, 0.0, 1.0, 100).length(), 0u);
  EXPECT_EQ(RayleighKernel(8.0, 1e300, 1.0, 100).length(), 100u);
  EXPECT_EQ(RayleighKernel(8.0, std::numeric_limits<double>::infinity(), 1.0, 100).length(), 100u);
}

}  // namespace
}  // namespace clay
