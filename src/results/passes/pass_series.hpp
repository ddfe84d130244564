#pragma once
// A series of passes by the stationary method: what each has done, and what the series has come to; of either method
// the verdict as a sentence, and the statement of the law behind it.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/material_strength.hpp"
#include "passes/pass_errors.hpp"
#include "passes/rail_passes.hpp"
#include "record/csv.hpp"
#include "steady/pass_jump.hpp"

namespace railstrata {

/// State of a series of passes.
struct PassSeries {
  CsvTable table;                   ///< passes.csv
  std::vector<PassStrain> strains;  ///< the largest of all points, of every pass; jumped ones: add_strain
  std::vector<PassStrain> cycles;   ///< the same of every whole cycle
  PassState state;
  int cycle = 1;  ///< passes that are judged as one: passes_per_cycle (passes/pass_plan.hpp)
  std::vector<std::vector<PassStrain>> points;  ///< per point of the section its last cycles, kPointPasses at most
  JumpMemory jump;                              ///< length 0: none
  std::vector<std::array<double, 7>> begun;  ///< per point plastic strain where the cycle began, Δp since; empty: none
};
/// Number of passes that classify() needs at a point.
inline constexpr std::size_t kPointPasses = 4;

/// Adds a pass: its `row` and its effect on the points. Of a cycle of several passes Δp is the sum over them and the
/// net strain that from its beginning to its end.
void add_pass(const PassRow& row, const PassResult& result, PassSeries& series);
/// Adds the strain of pass (or cycle) `number`, from 1; those jumped over before it lie on a power of the number
/// between their neighbours, or are as the one before where either is 0.
void add_strain(int number, const PassStrain& strain, std::vector<PassStrain>& strains);
/// Jumps over so many rounds to the history expected after them, where the next round begins.
void jump_over(int rounds, std::vector<double> history, PassSeries& series);
/// Verdict from the whole cycles; its rate is per pass.
PassVerdict verdict_of(const PassSeries& series);
/// Adds a pass to the last ones of a point.
void remember_pass(const PassStrain& strain, std::vector<PassStrain>& passes);
/// These in a state: kPointPasses times two numbers, NaN where there are fewer. Read: those of a row's from `first` on.
Columns<std::vector<PassStrain>> remembered_columns();
std::vector<PassStrain> remembered_passes(const CsvTable& state, std::size_t row, std::size_t first);
/// Progress of a series.
struct PassProgress {
  PassVerdict verdict;
  PassRow last;
  bool ever_yielded = false;
  int first_quiet = 0;                ///< the pass from which on nothing flowed
  std::optional<double> ductility{};  ///< passes.ductility of the case, equivalent strain
  std::optional<StrainLifeOfMaterial> strain_life{};
  PassErrors error{};
  int cycle = 1;  ///< as of PassSeries
};

/// strains: of every pass, the last one that of the row.
PassProgress progress_of(const PassVerdict& verdict, const std::vector<PassStrain>& strains, const PassRow& last);

/// "1 pass", "20 passes"
std::string passes_text(int passes);

/// One sentence: "Ratchets: 3.1e-04 net strain per pass at 2.1 mm depth, the same from pass to pass."; a second one
/// where the strain is no longer small.
std::string describe(const PassProgress& standing);

/// Long-term behaviour that a law allows, for any course of the passes so far: "perfect plasticity: …".
std::string describe_law(const PlasticParameters<double>& law);

}  // namespace railstrata
