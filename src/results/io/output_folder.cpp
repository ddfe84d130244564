#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/faults.hpp"
#include "io/checkpoint_file.hpp"
#include "io/kept_inputs.hpp"
#include "io/provenance.hpp"
#include "record/output_file.hpp"

namespace railstrata {

namespace {
constexpr const char* kProbe = ".writable";  // is made and removed: whether a folder can be written

/// Removes what `run` and `bem` write into a folder or one below it, but for the case and its origin.
void remove_results(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const char* name : {"centre_line.csv",
                           "depth_line.csv",
                           "force_spectrum.csv",
                           "geometry.json",
                           "history.csv",
                           "patch.csv",
                           "patch.pvd",
                           "patch.vtp",
                           "patch_film.csv",
                           "points_history.csv",
                           "rail.vtu",
                           "rail_cross_section.csv",
                           "rail_longitudinal_section.csv",
                           "rail_slices.csv",
                           "rail_surface.vtp",
                           "report.html",
                           "residual.csv",
                           "residual.json",
                           "section.vtp",
                           "shakedown.json",
                           "streamlines.csv",
                           "summary.json",
                           "view.py",
                           "wheel.vtu",
                           "wheel_cross_section.csv",
                           "wheel_longitudinal_section.csv",
                           "wheel_slices.csv",
                           "wheel_surface.vtp"})
    std::filesystem::remove(folder / name, ignored);
  for (const char* body : {"rail", "wheel"})
    for (const char* ending : {".csv", "_map.csv", "_sliding.csv"})
      std::filesystem::remove(folder / fmt::format("shakedown_{}{}", body, ending), ignored);
  std::vector<std::filesystem::path> frames;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string(); name.starts_with("patch_") && name.ends_with(".vtp"))
      frames.push_back(entry.path());
  for (const auto& frame : frames) std::filesystem::remove(frame, ignored);
}

// A run may go on elsewhere: what a device computes is the same but for rounding.
std::string without_device(std::string resolved) {
  constexpr const char* kKey = "\ndevice = ";  // of [run]; no other table has one
  if (const std::size_t at = resolved.find(kKey); at != std::string::npos)
    resolved.erase(at, resolved.find('\n', at + 1) - at);
  return resolved;
}

}  // namespace

FolderHold prepare_output_folder(const std::filesystem::path& folder, bool force, const std::function<bool()>& begun) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw EnvironmentError(fmt::format("cannot make the output folder {}: {}", folder.string(),
                                       error ? error.message() : "a file of this name already exists"),
                           "choose another with --out");
  FolderHold hold(folder, begun != nullptr);
  bool empty = true;  // but for what others that begin at this moment are still writing, or have left so
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    empty = empty && (is_part(entry->path().filename().string()) || entry->path().filename() == kProbe);
  if (error)
    throw EnvironmentError(fmt::format("cannot read the output folder {}: {}", folder.string(), error.message()));
  if (!empty && !(begun && begun()) && !force)  // asked after the look around: it may have come meanwhile
    throw CaseError(fmt::format("the output folder {} is not empty", folder.string()),
                    "choose another with --out, or overwrite files of the same name with --force");
  const std::filesystem::path probe = folder / kProbe;
  write_whole_file(probe, "");
  std::filesystem::remove(probe, error);
  return hold;
}

void clear_old_results(const std::filesystem::path& folder) {
  remove_results(folder);
  remove_checkpoints(folder);
  std::error_code ignored;
  std::vector<std::filesystem::path> parts;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string();
        entry.is_directory(ignored) &&
        (name.starts_with(kPositionFolder) || name == kReferenceFolder || name == kSeriesFolder))
      parts.push_back(entry.path());
  for (const auto& part : parts) {
    remove_results(part);
    if (part.filename() == kReferenceFolder)
      for (const char* name : {"case.toml", "case.original.toml", "provenance.json"})
        std::filesystem::remove(part / name, ignored);
    if (std::filesystem::is_empty(part, ignored)) std::filesystem::remove(part, ignored);
  }
}

void require_apart(const std::filesystem::path& folder, const LoadedCase& loaded) {
  std::error_code ignored;
  for (const char* name : {"case.toml", "case.original.toml"})
    if (std::filesystem::equivalent(folder / name, loaded.file, ignored))
      throw CaseError(fmt::format("the results in {} would replace the case file itself", folder.string()),
                      "choose another folder with --out");
}

void write_origin(const std::filesystem::path& folder, const LoadedCase& loaded,
                  const std::vector<std::string>& command_line, int threads) {
  const std::vector<KeptInput> inputs = kept_inputs(loaded, folder);
  copy_inputs(inputs, folder);
  const std::string text = "# Every option of the run; reads back to the same case.\n" + kept_case(loaded, inputs);
  KeptOrigin kept{sha256_of(text), {}};
  for (const KeptInput& input : inputs) kept.copies.emplace_back(input.source, input.kept);
  write_whole_file(folder / "case.toml", text);
  write_whole_file(folder / "case.original.toml", loaded.source_text);
  write_whole_file(folder / "provenance.json",
                   provenance_json(command_line, loaded.overrides, loaded.inputs, threads, kept));
}

void remove_parts(const std::filesystem::path& folder, PartsOf whom) {
  std::error_code ignored;
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string();
        entry.is_regular_file(ignored) && (whom == PartsOf::anyone ? is_part(name) : is_abandoned_part(name)))
      found.push_back(entry.path());
  for (const auto& file : found) std::filesystem::remove(file, ignored);
}

std::string case_identity(const LoadedCase& loaded) { return sha256_of(without_device(case_by_content(loaded))); }

std::string identity_in_folder(const std::filesystem::path& folder, const LoadedCase& loaded) {
  const std::filesystem::path kept = std::filesystem::absolute(folder / kInputsFolder).lexically_normal();
  const bool old = std::any_of(loaded.inputs.begin(), loaded.inputs.end(), [&](const std::filesystem::path& file) {
    return file != loaded.file && file.parent_path() != kept;
  });
  return old ? identity_by_path(loaded) : case_identity(loaded);
}

std::string identity_by_path(const LoadedCase& loaded) {
  std::string all = loaded.resolved_toml;
  for (const std::filesystem::path& file : loaded.inputs)
    if (std::filesystem::absolute(file) != std::filesystem::absolute(loaded.file)) all += sha256_of_file(file);
  return sha256_of(all);
}

std::vector<std::string> table_origin(const LoadedCase& loaded) {
  return {fmt::format("RailStrata {}", version_text()),
          fmt::format("case: {} ({})", loaded.file.filename().string(), loaded.spec.title),
          "x from the axle in the rolling direction, y towards the field side; tractions act on the rail"};
}

}  // namespace railstrata
