#include "device/device_of.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "core/faults.hpp"
#include "device/card.hpp"
#include "device/emulated_device.hpp"
#include "device/engine.hpp"

namespace railstrata::device {
namespace {

bool emulated_wanted() { return std::getenv("RAILSTRATA_EMULATED_DEVICE") != nullptr; }

}  // namespace

void require_at_hand() {
  if (!emulated_wanted()) require_card();
}

std::unique_ptr<Device> device_of(const CaseSpec& spec) {
  if (!spec.run.rolling || spec.run.device == ComputeDevice::cpu) return nullptr;
  if (emulated_wanted()) return std::make_unique<EmulatedDevice>(Protection::open, LaunchOrder::threads);
  return open_card();
}

EngineOf engine_on(Device* device) {
  if (!device) return {};
  return [device](const RollingSystem& system, const RollingBodies& bodies, double dt) -> std::unique_ptr<StepEngine> {
    if (const std::string what = not_on_a_device(system); !what.empty())
      throw CaseError(fmt::format("run.device: a device takes no {}", what), "run.device = \"cpu\"");
    return std::make_unique<Engine>(*device, system, bodies, dt);
  };
}

}  // namespace railstrata::device
