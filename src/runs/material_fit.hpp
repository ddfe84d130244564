#pragma once
// A law fitted to tests (material/calibrate.hpp): the card of a case and a picture of the fit.
#include <filesystem>
#include <string>
#include <vector>

#include "case/case_spec.hpp"
#include "material/calibrate.hpp"

namespace railstrata {

/// What is fitted: amplitudes of stabilised cycles or one stabilised loop, and a monotonic curve beside it. File names
/// empty: not given.
struct MaterialTests {
  std::filesystem::path loop, amplitudes, monotonic;
  int backstresses = 0;  ///< 0: as many as lower the error
};

struct MaterialFit {
  HardeningFit stabilised;  ///< of the loop or the amplitudes
  HardeningFit whole;       ///< with the monotonic curve; else the same
  bool of_loop = false;
  double amplitude = 0;                       ///< of the loop
  std::vector<CurvePoint> cyclic, monotonic;  ///< what was measured
};

/// Throws CaseError naming file and line.
MaterialFit fit_material(const MaterialTests& tests, double young);

/// Numbers rounded to five digits, as a case writes them.
PlasticParameters<double> rounded(const PlasticParameters<double>& law);

/// A case file's [material.rail] with the remarks as comments above it.
std::string material_card(const MaterialSpec& elastic, const PlasticParameters<double>& law,
                          const std::vector<std::string>& remarks);

std::string fit_picture(const std::string& title, const MaterialFit& fit, const std::vector<std::string>& remarks);

}  // namespace railstrata
