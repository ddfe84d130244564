#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "app/program.hpp"

namespace {

// Threads that spin long while they wait cost more than they win where cores are shared; those that sleep at once take
// longer to wake than many a sweep lasts. g++'s OpenMP runtime is set to spin for some ten microseconds, others to
// sleep. They read these settings before main() starts, so the program starts itself again.
void wait_briefly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "3000", 1);
  execv("/proc/self/exe", argv);  // comes back only where that is not possible: then it runs on as it is
}

}  // namespace

int main(int argc, char** argv) {
  wait_briefly(argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 16);  // whole lines, between those of stderr where one file takes both
  return railstrata::run_program(argc, argv);
}
