#include "runs/write_transient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "io/output_folder.hpp"
#include "io/result_files.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// The film of an interrupted run; none where it left none, or one that was cut.
std::optional<CsvTable> film_left_in(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return read_csv(file);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

bool rolls(const CaseSpec& spec) { return spec.transient.kind == TransientKind::rolling; }

}  // namespace

PatchSeries::PatchSeries(const fs::path& out, const std::vector<std::string>& provenance,
                         const std::vector<double>& times)
    : folder_(out / kSeriesFolder),
      series_(out / "patch.pvd"),
      left_(times.empty() ? std::nullopt : film_left_in(out / "patch_film.csv")),
      film_(out / (left_ ? "patch_film.csv" + part_ending() : "patch_film.csv"), provenance) {
  make_folder(folder_, Above::there);
  for (const double time : times) series_.add(time, next_file());
  if (!left_) return;
  film_.keep(*left_, frames_);
  left_.reset();  // the film replaces the earlier one when its frames are there: a kill loses none
  fs::rename(out / ("patch_film.csv" + part_ending()), out / "patch_film.csv");
}

void PatchSeries::add(double time, int step, double distance, const ContactField& field) {
  const fs::path file = next_file();
  film_.add(step, distance, field);
  write_vtp(file, patch_mesh({&field}, distance));
  series_.add(time, file);
}

fs::path PatchSeries::next_file() { return folder_ / fmt::format("patch_{:04d}.vtp", frames_++); }

TransientWriter::TransientWriter(const CaseSpec& spec, const fs::path& folder,
                                 const std::vector<std::string>& provenance)
    : wanted_frames_(spec.run.output.patch_series ? spec.run.output.series_frames : 0),
      log_(folder / "history.csv", provenance,
           transient_columns(rolls(spec), rolls(spec) || !spec.transient.at_time.empty())) {
  if (wanted_frames_ > 0) series_.emplace(folder, provenance);
}

/// The first state, and the first one at or beyond each part of the way.
bool TransientWriter::is_frame(const TransientState& state) const {
  if (wanted_frames_ == 0) return false;
  const auto parts = [&](int step) {
    return static_cast<long>(step) * std::min(wanted_frames_, state.steps) / std::max(state.steps, 1);
  };
  return state.step == 0 || parts(state.step) > parts(state.step - 1);
}

void TransientWriter::add(const TransientState& state) {
  log_.add(transient_row(state));
  if (is_frame(state))
    series_->add(std::isfinite(state.time) ? state.time : state.step, state.step, state.distance, state.result.field);
}

}  // namespace railstrata
