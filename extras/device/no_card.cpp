// In the place of card.cu, in a build without CUDA.
#include <stdexcept>

#include "core/faults.hpp"
#include "device/card.hpp"
#include "device/kernel_list.hpp"

namespace railstrata::device {

template <class Kernel>
void launch_on_card(std::ptrdiff_t, const Kernel&) {
  throw std::logic_error("a kernel was launched on a card that the program was not built for");
}

template <class Kernel>
void launch_group_on_card(const Kernel&) {
  throw std::logic_error("a kernel was launched on a card that the program was not built for");
}

#define RAILSTRATA_INSTANTIATE_GROUP(...) template void launch_group_on_card(const __VA_ARGS__&);
RAILSTRATA_EVERY_GROUP_KERNEL(RAILSTRATA_INSTANTIATE_GROUP)
#define RAILSTRATA_INSTANTIATE(...) template void launch_on_card(std::ptrdiff_t, const __VA_ARGS__&);
RAILSTRATA_EVERY_KERNEL(RAILSTRATA_INSTANTIATE)

bool built_for_cards() { return false; }

void require_card() {
  throw EnvironmentError(
      "this program was built without CUDA",
      "run.device = \"cpu\", or build it where nvcc is found (docs/gpu.md; cmake -DRAILSTRATA_CUDA=ON gives the "
      "reason if it is not)");
}

std::unique_ptr<Device> open_card() {
  require_card();
  return nullptr;
}

std::string card_name() { return {}; }

double card_copy_rate() { return 0; }

}  // namespace railstrata::device
