// Whole steps on the card against its memory, for tests/records/gpu.csv: JSON lines on the standard output, one for
// each mesh and precision. Exit code 77 without a card.
//
// Counted bytes of an element and step: its displacements and the rows of its corners written, those rows read by the
// nodes, and u, v (read and written) and the mass of a node. The roof is what the card's own copy kernel reaches in the
// same run.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/faults.hpp"
#include "device/card.hpp"
#include "device/engine.hpp"
#include "fem/stepper.hpp"
#include "reader/case_file.hpp"

using namespace railstrata;

namespace {

using Clock = std::chrono::steady_clock;

double counted_bytes(bool single) {
  const double real = single ? 4 : 8;
  return 24 + 2 * device::kCornerRows * real + 2 * 48 + 8;
}

void measure(device::Device& card, double copy_rate, const char* file, double element_size, bool single, int steps) {
  CaseSpec spec = load_case(file, {}).spec;
  spec.mesh.element_size = element_size;
  spec.run.precision = single ? ArithmeticPrecision::single_precision : ArithmeticPrecision::double_precision;
  const RollingSystem system(build_model(spec, "."));
  Stepper stepper(system, solve_preload(system, 1e-2));
  stepper.use([&](const RollingSystem& s, const RollingBodies& bodies, double dt) {
    return std::make_unique<device::Engine>(card, s, bodies, dt);
  });
  for (int k = 0; k < 100; ++k) stepper.step();
  const auto start = Clock::now();
  for (int k = 0; k < steps; ++k) stepper.step();
  card.finish();
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const double elements = static_cast<double>(system.model.rail.elements() + system.model.wheel.elements());
  const double rate = elements * steps / seconds;
  fmt::print(
      "{{\"elements\": {:.0f}, \"precision\": \"{}\", \"steps\": {}, \"element_steps_per_s\": {:.4g}, "
      "\"us_per_step\": {:.2f}, \"copy_bytes_per_s\": {:.4g}, \"counted_bytes\": {:.0f}, \"share_of_copy\": {:.3f}}}\n",
      elements, single ? "single" : "double", steps, rate, 1e6 * seconds / steps, copy_rate, counted_bytes(single),
      rate * counted_bytes(single) / copy_rate);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) {
    std::fputs("usage: measure_card CASE\n", stderr);
    return 2;
  }
  try {
    const auto card = device::open_card();
    fmt::print("{{\"device\": \"{}\"}}\n", device::card_name());
    const double copy_rate = device::card_copy_rate();
    for (const double size : {2e-3, 1e-3, 0.5e-3})
      for (const bool single : {false, true}) measure(*card, copy_rate, words[1], size, single, 2000);
  } catch (const EnvironmentError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 77;
  }
  return 0;
}
