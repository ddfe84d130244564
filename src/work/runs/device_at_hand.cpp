#include "runs/device_at_hand.hpp"

#include "device/device_of.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

constexpr const char* kKey = "run.device";

}  // namespace

void require_device(const CaseSpec& spec, const Ranks& ranks) {
  if (!spec.run.rolling) return;
  if (!ranks.alone()) require_support(uses::kRanks, spec);
  if (spec.run.device != ComputeDevice::cpu) device::require_at_hand();
}

void require_device(const LoadedCase& loaded, const Ranks& ranks) {
  try {
    with_places(loaded, [&] { require_device(loaded.spec, ranks); });
  } catch (const EnvironmentError& e) {
    const Diagnostic found = in_case_file(loaded, CaseError(e.what(), e.remedy, kKey)).diagnostics.front();
    throw EnvironmentError(found.where + ": " + found.message, found.remedy);
  }
}

}  // namespace railstrata
