#pragma once
// What a run of a case will cost, found without running it.
#include <string>

#include "model/model.hpp"

namespace railstrata {

struct RunEstimate {
  double stable_step = 0;    ///< s, of the free bodies, by Lanczos steps on the assembled system
  double element_bound = 0;  ///< s, the smallest of the isolated elements
  std::string limited_by;    ///< block of that element
  double step = 0;           ///< s, with the case's safety
  long steps = 0;            ///< over the path; 0 for a static case
  double seconds = 0;        ///< of explicit rolling: measured force evaluations on this machine, these threads; the preload comes on top
  double memory_bytes = 0;   ///< in use with both bodies ready for computing
};

RunEstimate estimate_run(const Model& model);

}  // namespace railstrata
