#pragma once
// The files of a transient that grow while it is followed.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/transient_files.hpp"
#include "record/vtk.hpp"

namespace railstrata {

/// history.csv, a row a step; with output.patch_series evenly spaced states, output.series_frames besides the first, as
/// patch.pvd with patch_series/ and as patch_film.csv. Into a folder that is there. Throws EnvironmentError for the
/// disk.
class TransientWriter {
 public:
  TransientWriter(const CaseSpec& spec, const std::filesystem::path& folder,
                  const std::vector<std::string>& provenance);
  void add(const TransientState& state);

 private:
  bool is_frame(const TransientState& state) const;
  int wanted_frames_;
  std::filesystem::path series_folder_;
  RecordLog<TransientRow> log_;
  std::optional<PatchFilm> film_;
  PvdSeries series_;
  int frames_ = 0;
};

}  // namespace railstrata
