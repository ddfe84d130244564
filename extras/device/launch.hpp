#pragma once
// Starting a kernel: a trivially copyable struct of views whose operator()(i) const does the work of index i. What one
// index writes no other reads or writes, and none adds to what another one has: a launch gives the same bits in any
// order.
#include <type_traits>

#include "device/emulated_device.hpp"

namespace railstrata::device {

/// On the card; compiled for every kernel of device/kernel_list.hpp (card.cu, or no_card.cpp in a build without CUDA).
template <class Kernel>
void launch_on_card(std::ptrdiff_t n, const Kernel& kernel);

/// kernel(i) for 0 <= i < n. Launches run one after the other.
template <class Kernel>
void launch(Device& device, std::ptrdiff_t n, const Kernel& kernel) {
  static_assert(std::is_trivially_copyable_v<Kernel>);
  if (n <= 0) return;
  if (EmulatedDevice* emulated = device.emulated())
    emulated->run(n, kernel);
  else
    launch_on_card(n, kernel);
}

/// One group of threads of a card, compiled as launch_on_card.
template <class Kernel>
void launch_group_on_card(const Kernel& kernel);

/// A kernel with barriers: kernel(group), where group.each(n, f) does f(i) for 0 <= i < n and group.once(f) does f
/// once, both done when they return. Within an `each` the rule of launches holds; what stands between must be the same
/// for all threads.
template <class Kernel>
void launch_group(Device& device, const Kernel& kernel) {
  static_assert(std::is_trivially_copyable_v<Kernel>);
  if (EmulatedDevice* emulated = device.emulated())
    emulated->run_group(kernel);
  else
    launch_group_on_card(kernel);
}

}  // namespace railstrata::device
