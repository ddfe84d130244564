#pragma once
// The files that grow while a transient is followed: history.csv, a row a step, and the patch on its way.
#include <filesystem>
#include <string>
#include <vector>

#include "io/result_files.hpp"
#include "record/csv.hpp"
#include "result/transient_row.hpp"

namespace railstrata {

/// history.csv of half-spaces (RecordLog). Columns that do not apply to what is followed are left out: a shift has
/// displacements and no creepages, what rolls the other way round.
Columns<TransientRow> transient_columns(bool rolls, bool timed);

/// A cell in contact, in a state of the patch on its way.
struct FilmCell {
  int step;
  double distance;  ///< m
  PatchPoint point;
};

/// patch_film.csv: cells in contact in a number of states (of finite elements nodes in frames, `distance` the wheel's
/// position), for the film of the page: at most some 80 cells along a side, pressures and tractions to a tenth of an
/// MPa.
class PatchFilm {
 public:
  PatchFilm(const std::filesystem::path& file, const std::vector<std::string>& provenance);
  void add(int step, double distance, const ContactField& field);
  /// The rows of an earlier film whose steps come before `end`.
  void keep(const CsvTable& earlier, int end);

 private:
  RecordLog<FilmCell> log_;
};

}  // namespace railstrata
