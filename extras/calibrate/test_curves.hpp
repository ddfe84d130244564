#pragma once
// Tables of material tests: curves to fit a law to.
//
//   strain, stress_MPa                        a curve; plastic_strain instead of strain
//   strain_amplitude, stress_amplitude_MPa    amplitudes; plastic_strain_amplitude too
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibrate.hpp"

namespace railstrata {

enum class TestCurve { curve, amplitudes };

/// Shear yield stresses of strained steel, columns sys and pss (plastic shear strain), as of uniaxial tension: √3 sys
/// over pss/√3. Throws CaseError with file, line and remedy, as all of this header.
std::vector<CurvePoint> read_shear_yield(const std::string& text, const std::filesystem::path& file);

/// Plastic strain is the total one less the stress over `young` [Pa]. Columns of other words are not read; `notes`
/// lists them, and reports columns taken as amplitudes although their names do not show it.
std::vector<CurvePoint> read_test_curve(const std::string& text, const std::filesystem::path& file, TestCurve kind,
                                        double young, std::vector<std::string>* notes = nullptr);

/// The same from numbers, of one length; plastic: the strains are plastic ones already.
std::vector<CurvePoint> test_curve_of(const std::vector<double>& strain, const std::vector<double>& stress,
                                      bool plastic, TestCurve kind, double young);

}  // namespace railstrata
