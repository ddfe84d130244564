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

}  // namespace railstrata::device
