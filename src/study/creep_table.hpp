#pragma once
// A creep-force table: half-space solutions over a grid of creepages, loads, places and whatever else a case says.
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bem/bem_options.hpp"
#include "case/case_file.hpp"
#include "table/force_table.hpp"

namespace railstrata {

/// An axis as it is asked for: a key of the case, or one of the words of creep_table_words(), and its values in SI.
struct CreepAxis {
  std::string word, key, unit;
  std::vector<double> at;
  std::vector<std::string> texts;  ///< as an override takes them
};

/// Words for keys that tables often have: creepage_x, creepage_y, spin, load, friction, lateral_shift, yaw.
std::vector<std::string> creep_table_words();

/// Reads "WORD=VALUES". VALUES: "v1,v2,…"; "from:to:count" at equal distances; "+-largest:count", odd, through 0 with
/// distances that grow by the same factor to both sides, over two and a half decades. Slopes are tangents. Throws
/// CaseError: an unknown word
/// or key, a key that is no number, values out of its range or that do not ascend, a creepage
/// and a force in one direction, more axes than a table may have.
std::vector<CreepAxis> parse_axes(const std::vector<std::string>& options);

/// As many solutions as a table may have.
inline constexpr std::size_t kMostTablePoints = 2'000'000;

struct CreepTableOptions {
  BemOptions bem;                                ///< its cache and neighbour are not used
  const std::atomic<bool>* stop = nullptr;       ///< true: rows that have not begun are left out
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
  /// Reads the case once for every combination of what is no creepage. Throws CaseError: the case refuses a value, too
  /// many points.
  CreepTable(const LoadedCase& base, const std::vector<std::string>& overrides, std::vector<CreepAxis> axes);
  ~CreepTable();
  CreepTable(CreepTable&&) noexcept;
  CreepTable& operator=(CreepTable&&) = delete;

  const ForceTable& table() const { return table_; }
  std::size_t points() const { return table_.points(); }
  std::size_t missing() const;                                        ///< points without an answer: one that failed
  const std::vector<std::string>& faults() const { return faults_; }  ///< each once, with the first place

  /// Axes along which no number of the table changes: the half-spaces do not read the key.
  std::vector<std::string> idle_axes() const;

  /// Rows that an earlier table of the same axes has whole need not be solved. Throws CaseError: other axes.
  void take(const ForceTable& earlier);

  void solve(const CreepTableOptions& options);

  /// The table's numbers at any place within the axes, solved for; empty where it fails.
  std::vector<double> direct(const std::vector<double>& point, const BemOptions& bem) const;

 private:
  struct Outer;
  struct Row;
  std::size_t outer_of(const std::vector<std::size_t>& index) const;
  CaseSpec spec_at(const Outer& outer, const std::vector<double>& point) const;
  Row row(std::size_t number) const;
  using Numbers = std::vector<double>;  ///< of a point; empty: there is no answer
  std::vector<Numbers> solve_row(const Row& row, const CreepTableOptions& options, InfluenceCache& cache);
  void note_fault(const std::vector<double>& point, const std::string& fault);

  LoadedCase base_;
  std::vector<std::string> overrides_;
  std::vector<CreepAxis> axes_;
  std::size_t row_axis_ = 0;
  ForceTable table_;
  std::vector<Outer> outer_;
  std::vector<std::string> faults_;
  std::unique_ptr<std::mutex> noting_;
};

/// How far interpolation is from direct solutions at places spread over the table.
struct TableError {
  struct Number {
    std::string name, unit;
    double largest = 0, mean = 0;  ///< absolute differences
    double scale = 0;              ///< the table's largest magnitude
  };
  int places = 0;
  std::vector<Number> numbers;
};
/// At `places` places of a fixed sequence of numbers. [Halton1960]
TableError interpolation_error(const CreepTable& table, int places, const CreepTableOptions& options);

}  // namespace railstrata
