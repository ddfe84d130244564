// Once it has run in, a step asks the heap for nothing: neither time nor fragments of memory are lost to it, and it
// cannot fail for want of memory.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

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
  const int threads_before = max_threads(), run_in = 64, steps = threads == 1 ? 320 : 64;
  set_threads(threads);
  const RollingSystem system = small_system(spec);
  Stepper st(system, solve_preload(system, 1e-3));
  roll(st, run_in);
  const Allocations before = allocations();
  const double start = st.position();
  roll(st, steps);
  const Allocations after = allocations();
  set_threads(threads_before);
  EXPECT_EQ(after.own - before.own, 0);
  EXPECT_GT(st.position(), start);
  EXPECT_GT(st.forces().nodes, 0);
  ::testing::Test::RecordProperty("steps_before", run_in);  // read by tools/allocations.py
  ::testing::Test::RecordProperty("steps", steps);
  ::testing::Test::RecordProperty("allocations", std::to_string(after.own - before.own));
  ::testing::Test::RecordProperty("allocations_of_openmp", std::to_string(after.openmp - before.openmp));
}

CaseSpec variant(const std::string& name) {
  CaseSpec spec = small_case();
  if (name == "run_up_damping") {
    spec.run.run_up = 0.02;
    spec.run.run_up_damping = 2000;
  } else if (name == "single_precision")
    spec.run.precision = ArithmeticPrecision::single_precision;
  else if (name == "mass_scaling")
    spec = thinly_layered(spec);
  return spec;
}

}  // namespace

class Allocation : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(Allocation, NoneInTheTimeLoop) {
  expect_no_allocation(variant(std::get<0>(GetParam())), std::get<1>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Stepper, Allocation,
                         ::testing::Combine(::testing::Values("mortar", "run_up_damping", "single_precision",
                                                              "mass_scaling"),
                                            ::testing::Values(1, 2)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + (std::get<1>(test.param) == 1 ? "_1_thread" : "_2_threads");
                         });

}  // namespace railstrata
