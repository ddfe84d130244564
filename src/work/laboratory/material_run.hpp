#pragma once
// A material law driven along a path (material/material_path.hpp): tables and a picture of it.
#include <array>
#include <string>
#include <vector>

#include "core/control.hpp"
#include "reader/case_file.hpp"
#include "record/csv.hpp"
#include "tables/material_tables.hpp"

namespace railstrata {

/// Result of one cycle through the rows of a path.
struct MaterialCycle {
  int number = 0;               ///< from 1 on
  std::array<double, 6> net{};  ///< change of plastic strain
  double accumulated = 0;       ///< of p
  double largest_net() const;   ///< magnitude of its largest component
};

struct MaterialRun {
  std::vector<MaterialState> states;  ///< at the points, `cycles` times through the rows
  std::vector<MaterialState> trace;   ///< on the way, for pictures
  std::vector<MaterialCycle> cycles;
  int increments = 0;       ///< a row, of the finest run
  double strain_error = 0;  ///< largest ± of a component of strain, plastic strain or p at a point
  double stress_error = 0;  ///< Pa, of a component of stress
};

/// A material of a card.
struct ChosenMaterial {
  MaterialSpec spec;
  std::string name, key;  ///< key: "material.rail", "layer.0"
};
/// word: "rail", "wheel", "layer.0" or a layer's name. Throws CaseError: the card has no such.
ChosenMaterial choose_material(const LoadedCase& card, const std::string& word);

/// The law of yielding at a depth [m].
struct ChosenLaw {
  PlasticMaterial material;
  std::vector<std::string> notes;  ///< what is an estimate
};
/// Throws CaseError: it is elastic on purpose, or has no yield strength; faults of its laws.
ChosenLaw law_of(const LoadedCase& card, const ChosenMaterial& chosen, double depth);

/// Goes through the rows `cycles` times. Backward Euler is of first order in the increments: they are doubled, from
/// `increments` a row on, and the states extrapolated to none (2 fine - coarse), until two extrapolations differ by
/// less than a thousandth of the largest plastic strain and stress, eight times at most; their difference is the error.
/// Throws CaseError with the row's place where the material cannot follow,
/// Interrupted when `stop` is set.
MaterialRun run_material(const PlasticMaterial& material, const MaterialPathTable& table, int increments, int cycles,
                         const Control* control = nullptr);

/// s_xx_MPa .. s_xz_MPa, p by point; of a path of stresses with the strains before them.
std::vector<CsvColumn> point_columns(const MaterialRun& run, bool strains);
/// Net plastic strain and accumulated plastic strain of each cycle.
std::vector<CsvColumn> cycle_columns(const MaterialRun& run);

/// Loops of the components that move most, and the plastic strain along the path or, of several cycles, by cycle.
std::string path_picture(const std::string& title, const MaterialRun& run, const std::vector<std::string>& remarks);

/// "200 increments a row, extrapolated: ± 0.001 % of strain, ± 0.2 MPa".
std::string increments_text(const MaterialRun& run);

/// Equivalent plastic strain √(2/3 E^p:E^p), the largest of the trace.
double largest_plastic_strain(const MaterialRun& run);

}  // namespace railstrata
