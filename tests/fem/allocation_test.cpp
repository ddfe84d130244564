// Once it has run in, a step asks the heap for nothing: neither time nor fragments of memory are lost to it, and it cannot fail for want of memory.
#include <gtest/gtest.h>

#include "allocation_counter.hpp"
#include "core/parallel.hpp"
#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

// Steps without and with energies, several contact searches, the rail's patch moving on over its mesh.
void roll(Stepper& st, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (k % 5 == 0) st.want_energy();
    st.step();
  }
}

void expect_no_allocation(const CaseSpec& spec, int threads) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer looks after the heap";
  const int threads_before = max_threads();
  set_threads(threads);
  const RollingSystem system = small_system(spec);
  Stepper st(system, solve_preload(system, 1e-3));
  constexpr int kBefore = 64, kSteps = 320;
  roll(st, kBefore);
  const long before = allocations();
  const double start = st.position();
  roll(st, kSteps);
  const long asked = allocations() - before;
  set_threads(threads_before);
  EXPECT_EQ(asked, 0);
  EXPECT_GT(st.position(), start);
  EXPECT_GT(st.forces().nodes, 0);
  ::testing::Test::RecordProperty("steps_before", kBefore);  // read by tools/allocations.py
  ::testing::Test::RecordProperty("steps", kSteps);
  ::testing::Test::RecordProperty("allocations", std::to_string(asked));
}

CaseSpec layered_case(const char* method) {
  CaseSpec spec = small_case();
  spec.layers.emplace_back();
  spec.layers.back().thickness = 1e-3;
  spec.layers.back().width = 0.02;
  spec.run.time_step_method = method;
  return spec;
}

struct Variant {
  const char* name;
  CaseSpec spec;
};

std::vector<Variant> variants() {
  CaseSpec damped = small_case(), single = small_case(), penalty = small_case();
  damped.run.run_up = 0.02;
  damped.run.run_up_damping = 2000;
  single.run.precision = "single";
  penalty.contact.method = "penalty";
  return {{"mortar", small_case()}, {"damped", damped}, {"single_precision", single}, {"penalty", penalty}, {"mass_scaling", layered_case("mass_scaling")}, {"local_steps", layered_case("local")}};
}

}  // namespace

class Allocation : public ::testing::TestWithParam<std::tuple<Variant, int>> {};

TEST_P(Allocation, NoneInTheTimeLoop) { expect_no_allocation(std::get<0>(GetParam()).spec, std::get<1>(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Stepper, Allocation, ::testing::Combine(::testing::ValuesIn(variants()), ::testing::Values(1, 2)),
                         [](const auto& info) { return std::string(std::get<0>(info.param).name) + (std::get<1>(info.param) == 1 ? "_1_thread" : "_2_threads"); });

}  // namespace railstrata
