#pragma once
// Tables of material tests: paths to drive a law along, curves to fit one to.
//
//   e_xx, e_yy, e_zz, e_xy, e_yz, e_xz        a strain path: tensor shears; also in per cent, "e_xx [%]"
//   s_xx_MPa, s_xy_MPa                        a stress path; e_xx instead of s_xx prescribes the strain of a direction
//   strain, stress_MPa                        a curve; plastic_strain instead of strain
//   strain_amplitude, stress_amplitude_MPa    amplitudes; plastic_strain_amplitude too
#include <filesystem>
#include <string>
#include <vector>

#include "material/calibrate.hpp"
#include "material/material_path.hpp"

namespace railstrata {

struct MaterialPathTable {
  MaterialPath path;
  std::vector<int> lines;  ///< of the points
};

/// `absent`: what a component without a column has at zero. Of a strain path (`absent` strain) there are strains alone.
/// Throws CaseError with file, line and remedy, as all of this header.
MaterialPathTable read_material_path(const std::string& text, const std::filesystem::path& file, Prescribed absent);

enum class TestCurve { curve, amplitudes };

/// Plastic strain is the total one less the stress over `young` [Pa].
std::vector<CurvePoint> read_test_curve(const std::string& text, const std::filesystem::path& file, TestCurve kind,
                                        double young);

}  // namespace railstrata
