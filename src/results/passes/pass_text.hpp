#pragma once
// The verdict of a series of passes as a sentence, and the statement of the law behind it.
#include <optional>
#include <string>

#include "material/plastic.hpp"
#include "model/material_strength.hpp"
#include "passes/rail_passes.hpp"

namespace railstrata {

/// Progress of a series.
struct PassProgress {
  PassVerdict verdict;
  PassRow last;
  bool ever_yielded = false;
  int first_quiet = 0;                ///< the pass from which on nothing flowed
  std::optional<double> ductility{};  ///< passes.ductility of the case, equivalent strain
  std::optional<StrainLifeOfMaterial> strain_life{};
};

/// One sentence: "Ratchets: 3.1e-04 net strain per pass at 2.1 mm depth, the same from pass to pass."; a second one
/// where the strain is no longer small.
std::string describe(const PassProgress& standing);

/// Long-term behaviour that a law allows, for any course of the passes so far: "perfect plasticity: …".
std::string describe_law(const PlasticParameters<double>& law);

}  // namespace railstrata
