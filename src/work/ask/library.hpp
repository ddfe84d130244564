#pragma once
// Interface of librailstrata.so to other programs: a case file in, plain values out. Nothing is printed or written, no
// signal is caught. Only headers that need nothing but the C++ standard library are installed, and no type in them
// depends on the width of a SIMD pack: the loader may put a library for another instruction set below a program.
#include <string>
#include <vector>

#include "bem/patch_grid.hpp"
#include "contact/contact_field.hpp"
#include "reader/case_file.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// A solved case.
struct CaseResult {
  Summary summary;                 ///< the numbers and checks of summary.json
  ContactField patch;              ///< pressure, traction and slip at the points of the patch
  std::vector<std::string> notes;  ///< what the user should know
};

struct HalfSpaceSettings {
  double cell = kDefaultCell;  ///< m, side of the cells of the potential contact area, 0.02e-3 to 5e-3
  int threads = 0;             ///< 0: as many as OpenMP gives the calling thread
};

/// Solves a case by half-space theory [Kalker1990], as `railstrata bem` does. A static case (run.rolling = false) has
/// frictionless contact; of a transient the result is its last state. Several threads may solve at a time. Throws
/// CaseError (an input, or a patch that theory cannot give), NumericalError, EnvironmentError.
CaseResult solve_by_half_spaces(const LoadedCase& loaded, const HalfSpaceSettings& settings = {});

}  // namespace railstrata
