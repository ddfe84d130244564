// The explorer as three C functions: all that a page can call of a WebAssembly module.
#include "explore/calls.h"

#include "explore/solve.hpp"

namespace {

railstrata::ExplorerAnswer& last() {
  static railstrata::ExplorerAnswer answer;
  return answer;
}

}  // namespace

extern "C" {

const char* rs_explore(const char* request) {
  static railstrata::Explorer explorer;
  last() = explorer.answer(request ? request : "");
  return last().head.c_str();
}

const float* rs_explore_numbers(void) { return last().numbers.data(); }

int rs_explore_count(void) { return static_cast<int>(last().numbers.size()); }

}  // extern "C"
