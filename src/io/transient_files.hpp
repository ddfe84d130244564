#pragma once
// The files that grow while a transient is followed: history.csv, a row a step, and the patch on its way.
#include <filesystem>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "result/transient_row.hpp"

namespace railstrata {

/// history.csv of half-spaces. Columns that do not apply to what is followed are left out: a shift has displacements
/// and no creepages, what rolls the other way round.
class TransientLog {
 public:
  TransientLog(const std::filesystem::path& file, const std::vector<std::string>& provenance, bool rolls, bool timed);
  void add(const TransientRow& row);

 private:
  bool rolls_, timed_;
  CsvLog log_;
};

/// patch_film.csv: cells in contact in a number of states (of finite elements nodes in frames, `distance` the wheel's
/// position), for the film of the page: at most some 80 cells along a
/// side, pressures and tractions to a tenth of an MPa.
class PatchFilm {
 public:
  PatchFilm(const std::filesystem::path& file, const std::vector<std::string>& provenance);
  void add(int step, double distance, const ContactField& field);
  /// The rows of an earlier film whose steps come before `end`.
  void keep(const CsvTable& earlier, int end);

 private:
  CsvLog log_;
};

}  // namespace railstrata
