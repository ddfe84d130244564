#pragma once
// The device that a case asks for.
#include "device/memory.hpp"
#include "fem/step_engine.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata::device {

/// Throws EnvironmentError with what to do where the program was built without CUDA or no card is found. Opens nothing.
/// For tests of the whole program RAILSTRATA_EMULATED_DEVICE in the environment puts an emulated device in its place.
void require_at_hand();

/// Opens run.device; null for the processor, and for a case that does not roll. Throws as require_at_hand.
std::unique_ptr<Device> device_of(const CaseSpec& spec);

/// Function that puts the fields of a rolling on a device, which must live longer; empty without one. Throws CaseError
/// for what a device cannot take.
EngineOf engine_on(Device* device);

}  // namespace railstrata::device
