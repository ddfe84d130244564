#pragma once
// Errors of the numbers of a series of passes: what stations, columns, rows, the steps of the law and the cells of the
// contact leave uncertain.
//
// The same passes run on two coarser grids, r = 2 and 3/2 times as coarse in all of these together. A number f with f_r
// there is taken to be of first order, the least that was seen (the law takes steps of first order, the rest is of
// second order away from the surface):
//
//   ± = 1.25 max over r of |f - f_r| / (r - 1),   of depths a row more,
//
// with the factor of safety for three grids [Roache1994]. Numbers of a pass take the largest over the last four passes:
// a rate that falls may agree in one of them. Strains are compared by their share.
#include <string>
#include <utility>
#include <vector>

#include "record/csv.hpp"
#include "spec/case_spec.hpp"
#include "steady/pass_class.hpp"

namespace railstrata {

/// Half width of a number's bar by its difference from a grid `coarser` times as coarse, of first order, with the
/// factor of safety for three grids.
double grid_bar(double difference, double coarser);

/// What the error of a series needs of the series itself and of each coarser one.
struct ComparedPasses {
  double coarser = 1;  ///< r
  CsvTable table;      ///< passes.csv, with the same last passes
  double strain = 0;   ///< largest equivalent plastic strain
  PassClass kind = PassClass::transient;
};

struct PassErrors {
  /// Columns of passes.csv with the half width of the last pass's bar, in their units; empty: not known.
  std::vector<std::pair<std::string, double>> last;
  double strain = 0;               ///< of the largest equivalent plastic strain
  std::vector<PassClass> classes;  ///< of the coarser series

  bool known() const { return !last.empty(); }
  /// NaN: not known.
  double of(const std::string& column) const;
};

/// Of a number beyond which it has not converged with the grid.
inline constexpr double kNotConverged = 0.3;

/// The r of the coarser grids that are possible: patch_cells stays whole and at least 2.
std::vector<double> coarser_grids(const PassesSpec& passes);
/// The same passes on a grid r times as coarse.
PassesSpec on_coarser_grid(PassesSpec passes, double r);

/// rows: m, their thicknesses.
PassErrors pass_errors(const ComparedPasses& passes, const std::vector<ComparedPasses>& coarser,
                       const std::vector<double>& rows);

/// Columns of passes.csv whose error in the last pass is more than kNotConverged of them, in words: "net strain".
/// Strains of no flow (kNoFlow) and stresses below a twentieth of the larger one count as converged.
std::vector<std::string> not_converged(const PassErrors& errors, const CsvTable& table);

/// "3.1e-4 ± 0.4e-4": a strain with its error; without one where that is NaN.
std::string strain_text(double strain, double error);

}  // namespace railstrata
