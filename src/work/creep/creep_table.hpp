#pragma once
// A creep-force table: half-space solutions over a grid of creepages, loads, places and any other key of a case.
#include <array>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bem/bem_options.hpp"
#include "core/control.hpp"
#include "many/axis.hpp"
#include "model/model.hpp"
#include "reader/case_file.hpp"
#include "table/force_table.hpp"

namespace railstrata {

/// The numbers of a point in the order of the table's.
inline constexpr std::size_t kCreepNumbers = 10;
using CreepNumbers = std::array<double, kCreepNumbers>;

/// Points of a scaled table (table/force_table.hpp) along its first three axes.
struct ScaledCounts {
  int angles = 10, spins = 7, sizes = 9;
};

struct CreepTableOptions {
  BemOptions bem;                                ///< its cache and neighbour are not used
  const Control* control = nullptr;              ///< asked to stop, rows that have not begun are left out
  std::function<void(std::size_t done)> solved;  ///< after every row, one at a time: points that are there
};

/// Force, moment and patch over the axes; N, N m, Pa, m, W. Forces act on the wheel: along x, lateral in the contact
/// plane, along the contact normal, moment about it. `slip` is the share of the patch that slips, `bound` the friction
/// force over friction times normal force, 1 in full sliding.
///
/// Rows along the last creepage's axis (else the last axis) begin afresh and start each solution from the one before,
/// so that a table does not depend on the number of threads or on interruptions.
class CreepTable {
 public:
  /// Loads the case once for every combination of the axes that are not creepages. A scaled table takes the ends of the
  /// axes creepage_x, creepage_y and spin, and has its own three in their place. Throws CaseError: the case refuses a
  /// value or two axes together, too many points, a scaled table without one of the three.
  CreepTable(const LoadedCase& base, std::vector<NumberAxis> axes, std::optional<ScaledCounts> scaled = {});
  const ForceTable& table() const { return table_; }
  std::size_t points() const { return table_.points(); }
  std::size_t missing() const;                                        ///< points without an answer: one that failed
  const std::vector<std::string>& faults() const { return faults_; }  ///< each once, with the first place

  /// Axes along which no number of the table changes: the half-spaces do not read the key.
  std::vector<std::string> idle_axes() const;

  /// Rows that an earlier table of the same axes has whole need not be solved. Throws CaseError: other axes.
  void take(const ForceTable& earlier);

  void solve(const CreepTableOptions& options);

  /// "creepage_x = -0.001, load = 80000 N": a place as it is asked for.
  std::string place_words(const std::vector<double>& asked, bool without_creepages = false) const;

  /// The numbers at any place within the axes as they are asked for, solved for; none where it fails.
  std::optional<CreepNumbers> direct(const std::vector<double>& point, const BemOptions& bem) const;

 private:
  /// The case at a combination of what is no creepage, or why there is none.
  struct Outer {
    std::optional<CaseSpec> spec;
    Placement placement;
    std::string fault;
  };
  /// Points along one axis, in its order.
  struct Row {
    std::size_t first = 0, stride = 1;
  };
  std::vector<std::size_t> index_of(std::size_t point) const;
  const Outer& outer_at(std::size_t point) const;
  Outer load(const std::vector<std::string>& values) const;
  CaseSpec spec_at(const Outer& outer, const std::vector<double>& asked) const;
  void start_scaled(const ScaledCounts& counts);
  void check_scaled() const;
  void find_scaling(const CreepTableOptions& options);
  CreepStiffness stiffness_of(const Outer& outer, const ScaledLoad& at, const BemOptions& bem) const;
  Row row(std::size_t number) const;
  std::vector<std::optional<CreepNumbers>> solve_row(const Row& row, const CreepTableOptions& options,
                                                     InfluenceCache& cache);
  void note_fault(std::size_t point, const std::string& fault);

  LoadedCase base_;
  std::vector<NumberAxis> axes_;
  std::size_t row_axis_ = 0;
  ForceTable table_;
  std::vector<Outer> outer_;
  std::vector<std::string> faults_;
  std::mutex noting_;
};

}  // namespace railstrata
