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
  std::filesystem::path file;  ///< empty: the points were given as numbers
  std::vector<int> lines;      ///< of the points; of numbers their rows, the first one is 0
  /// "FILE:LINE", or "row ROW".
  std::string where(std::size_t point) const;
};

/// `absent`: what a component without a column has at zero. Of a strain path (`absent` strain) there are strains alone.
/// Throws CaseError with file, line and remedy, as all of this header.
MaterialPathTable read_material_path(const std::string& text, const std::filesystem::path& file, Prescribed absent);

/// A component of a path as numbers: "e_xx" [-], "s_xy" [Pa]; all of one length.
struct PathColumn {
  std::string name;
  std::vector<double> values;
};
/// The same from numbers.
MaterialPathTable material_path_of(const std::vector<PathColumn>& columns, Prescribed absent);

enum class TestCurve { curve, amplitudes };

/// Shear yield stresses of strained steel, columns sys and pss (plastic shear strain), as of uniaxial tension: √3 sys
/// over pss/√3.
std::vector<CurvePoint> read_shear_yield(const std::string& text, const std::filesystem::path& file);

/// Plastic strain is the total one less the stress over `young` [Pa]. Columns of other words are not read; `notes`
/// lists them, and reports columns taken as amplitudes although their names do not show it.
std::vector<CurvePoint> read_test_curve(const std::string& text, const std::filesystem::path& file, TestCurve kind,
                                        double young, std::vector<std::string>* notes = nullptr);

/// The same from numbers, of one length; plastic: the strains are plastic ones already.
std::vector<CurvePoint> test_curve_of(const std::vector<double>& strain, const std::vector<double>& stress,
                                      bool plastic, TestCurve kind, double young);

}  // namespace railstrata
