#pragma once
// The card: CUDA's device 0, if the program was built for one and one is there.
#include <string>

#include "device/memory.hpp"

namespace railstrata::device {

/// Whether card.cu was compiled into the program, or no_card.cpp in its place.
bool built_for_cards();

/// Throws EnvironmentError with what to do: the program was built without CUDA, there is no card or no driver. Opens
/// nothing.
void require_card();

/// Throws as require_card.
std::unique_ptr<Device> open_card();

/// "NVIDIA H100 80GB HBM3, compute capability 9.0, 79.2 GiB, driver 13.0, runtime 13.0"; empty without a card.
std::string card_name();

/// Bytes a second, read and written together, of a kernel on the card that copies an array much larger than its cache.
double card_copy_rate();

}  // namespace railstrata::device
