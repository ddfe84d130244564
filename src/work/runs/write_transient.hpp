#pragma once
// The files of a transient that grow while it is followed.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/result_files.hpp"
#include "record/vtk.hpp"

namespace railstrata {

/// patch.pvd with its frames in patch_series/, and the same as patch_film.csv, in a folder that is there.
class PatchSeries {
 public:
  /// times: of the frames that an interrupted run has left there. Throws EnvironmentError for the disk.
  PatchSeries(const std::filesystem::path& out, const std::vector<std::string>& provenance,
              const std::vector<double>& times = {});
  /// step: of the film.
  void add(double time, int step, double distance, const ContactField& field);
  int frames() const { return frames_; }

 private:
  std::filesystem::path next_file();
  std::filesystem::path folder_;
  PvdSeries series_;
  std::optional<CsvTable> left_;
  PatchFilm film_;
  int frames_ = 0;
};

/// history.csv, a row a step; with output.patch_series a PatchSeries of evenly spaced states, output.series_frames
/// besides the first. Into a folder that is there. Throws EnvironmentError for the disk.
class TransientWriter {
 public:
  TransientWriter(const CaseSpec& spec, const std::filesystem::path& folder,
                  const std::vector<std::string>& provenance);
  void add(const TransientState& state);

 private:
  bool is_frame(const TransientState& state) const;
  int wanted_frames_;
  RecordLog<TransientRow> log_;
  std::optional<PatchSeries> series_;
};

}  // namespace railstrata
