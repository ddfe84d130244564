#pragma once
// A material law driven along a path (material/material_path.hpp): tables and a picture of it.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "case/material_tables.hpp"
#include "io/csv.hpp"

namespace railstrata {

/// What one time through the rows of a path leaves.
struct MaterialCycle {
  std::array<double, 6> net{};  ///< change of plastic strain
  double accumulated = 0;       ///< of p
  double largest_net() const;   ///< magnitude of its largest component
};

struct MaterialRun {
  std::vector<MaterialState> states;  ///< at the points, `cycles` times through the rows
  std::vector<MaterialState> trace;   ///< on the way, for pictures
  std::vector<MaterialCycle> cycles;
};

/// Goes through the rows `cycles` times. Throws CaseError with file and line where the material cannot follow.
MaterialRun run_material(const PlasticMaterial& material, const MaterialPathTable& table,
                         const std::filesystem::path& file, int increments, int cycles);

/// s_xx_MPa .. s_xz_MPa, p by point; of a path of stresses with the strains before them.
std::vector<CsvColumn> point_columns(const MaterialRun& run, bool strains);
/// Net plastic strain and accumulated plastic strain of each cycle.
std::vector<CsvColumn> cycle_columns(const MaterialRun& run);

/// Loops of the components that move most, and the plastic strain along the path or, of several cycles, by cycle.
std::string path_picture(const std::string& title, const MaterialRun& run, const std::vector<std::string>& remarks);

/// Equivalent plastic strain √(2/3 E^p:E^p), the largest of the trace.
double largest_plastic_strain(const MaterialRun& run);

}  // namespace railstrata
