#include "runs/write_transient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/output_folder.hpp"
#include "io/result_files.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

bool rolls(const CaseSpec& spec) { return spec.transient.kind == TransientKind::rolling; }

}  // namespace

TransientWriter::TransientWriter(const CaseSpec& spec, const std::filesystem::path& folder,
                                 const std::vector<std::string>& provenance)
    : wanted_frames_(spec.run.output.patch_series ? spec.run.output.series_frames : 0),
      series_folder_(folder / kSeriesFolder),
      log_(folder / "history.csv", provenance,
           transient_columns(rolls(spec), rolls(spec) || !spec.transient.at_time.empty())),
      series_(folder / "patch.pvd") {
  if (wanted_frames_ == 0) return;
  make_folder(series_folder_, Above::there);
  film_.emplace(folder / "patch_film.csv", provenance);
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
  if (!is_frame(state)) return;
  const ContactField& field = state.result.field;
  const std::filesystem::path file = series_folder_ / fmt::format("patch_{:04d}.vtp", frames_++);
  write_vtp(file, patch_mesh({&field}, state.distance));
  series_.add(std::isfinite(state.time) ? state.time : state.step, file);
  film_->add(state.step, state.distance, field);
}

}  // namespace railstrata
