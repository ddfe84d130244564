#include <unistd.h>

#include <cstdlib>

#include "app/program.hpp"

namespace {

// Threads that spin while they wait cost more than they win where cores are shared. The OpenMP runtime reads this wish before main() starts, hence once more from the top.
void wait_passively(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv);  // comes back only where that is not possible: then it runs on as it is
}

}  // namespace

int main(int argc, char** argv) {
  wait_passively(argv);
  return railstrata::run_program(argc, argv);
}
