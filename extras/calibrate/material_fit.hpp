#pragma once
// A law fitted to tests (calibrate.hpp): the card of a case and a picture of the fit.
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibrate.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Test data of a fit: amplitudes of stabilised cycles or one stabilised loop, and a monotonic curve beside it. File
/// names empty: not given.
struct MaterialTests {
  std::filesystem::path loop, amplitudes, monotonic;
  std::filesystem::path shear_yield;  ///< shear yield stress over plastic shear strain, alone
  int backstresses = 0;               ///< 0: as many as lower the error
};

struct MaterialFit {
  HardeningFit stabilised;  ///< of the loop or the amplitudes
  HardeningFit whole;       ///< with the monotonic curve; else the same
  bool of_loop = false, of_shear_yield = false;
  double amplitude = 0;                       ///< of the loop
  std::vector<CurvePoint> cyclic, monotonic;  ///< what was measured
  std::vector<std::string> notes;             ///< doubts about the tests and the fit
};

/// Throws CaseError naming file and line.
MaterialFit fit_material(const MaterialTests& tests, double young);

/// The same from what was measured.
struct MaterialCurves {
  std::vector<CurvePoint> cyclic;  ///< of a loop, point by point once around, or amplitudes
  bool of_loop = false;
  std::vector<CurvePoint> monotonic;          ///< empty: none
  std::string cyclic_place, monotonic_place;  ///< for messages
  int backstresses = 0;                       ///< 0: as many as lower the error
  std::vector<std::string> notes;             ///< of reading them
};
/// A monotonic curve whose stresses are all negative is one of compression: both signs are changed. Notes: of plastic
/// strains beyond 5 %, of tension 10 %, a rate b at the edge of its search. Throws CaseError with their place.
MaterialFit fit_curves(MaterialCurves curves);

/// How good the fit is, to stand above its card; names of what it was fitted to, monotonic empty: none.
std::vector<std::string> fit_remarks(const MaterialFit& fit, const std::string& cyclic, const std::string& monotonic);

/// Numbers rounded to five digits, as a case writes them.
PlasticParameters<double> rounded(const PlasticParameters<double>& law);

/// A case file's [material.rail] with the remarks as comments above it. Throws CaseError where a case would refuse its
/// numbers.
std::string material_card(const MaterialSpec& elastic, const PlasticParameters<double>& law,
                          const std::vector<std::string>& remarks);

std::string fit_picture(const std::string& title, const MaterialFit& fit, const std::vector<std::string>& remarks);

}  // namespace railstrata
