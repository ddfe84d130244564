#include "device/emulated_device.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace railstrata::device {
namespace {

struct Doubles {
  View<const int> from;
  View<int> to;
  void operator()(std::ptrdiff_t i) const { to[i] = 2 * from[i]; }
};

// Reads its neighbour's result: what a kernel must not do.
struct RunningSum {
  View<int> numbers;
  void operator()(std::ptrdiff_t i) const {
    if (i > 0) numbers[i] += numbers[i - 1];
  }
};

std::vector<int> count_to(int n) {
  std::vector<int> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

std::vector<int> doubled(LaunchOrder order) {
  EmulatedDevice device(Protection::closed, order);
  const DeviceArray<int> from(device, std::span<const int>(count_to(5000)));
  DeviceArray<int> to(device, from.size());
  device.run(5000, Doubles{from.view(), to.view()});
  return to.values();
}

std::vector<int> summed(LaunchOrder order) {
  EmulatedDevice device(Protection::closed, order);
  DeviceArray<int> numbers(device, std::span<const int>(count_to(100)));
  device.run(100, RunningSum{numbers.view()});
  return numbers.values();
}

}  // namespace

TEST(EmulatedDevice, ALaunchDoesTheWorkOfEveryIndexInAnyOrder) {
  std::vector<int> expected = count_to(5000);
  for (int& x : expected) x *= 2;
  for (const LaunchOrder order : {LaunchOrder::forward, LaunchOrder::backward, LaunchOrder::threads})
    EXPECT_EQ(doubled(order), expected);
}

TEST(EmulatedDevice, WhatDependsOnTheOrderIsSeenByTurningItRound) {
  EXPECT_NE(summed(LaunchOrder::forward), summed(LaunchOrder::backward));
}

TEST(EmulatedDevice, ArraysAreZeroAndGoBack) {
  EmulatedDevice device;
  {
    const DeviceArray<double> zero(device, 1000);
    EXPECT_EQ(zero.values(), std::vector<double>(1000, 0.0));
    EXPECT_GE(device.allocated(), 8000u);
  }
  EXPECT_EQ(device.allocated(), 0u);
}

TEST(EmulatedDeviceDeathTest, TheHostCannotReadMemoryOfTheDevice) {
  EmulatedDevice device;
  DeviceArray<int> array(device, 10);
  const View<int> view = array.view();
  EXPECT_DEATH(std::exit(view[0] == 0 ? 0 : 1), "");
}

TEST(EmulatedDeviceDeathTest, AnIndexTooFarEndsTheTest) {
  EmulatedDevice device;
  DeviceArray<double> array(device, 64), behind(device, 64);
  const View<double> view = array.view();
  const auto kernel = [view](std::ptrdiff_t) { view[64] = 1; };
  EXPECT_DEATH(device.run(1, kernel), "");
}

}  // namespace railstrata::device
