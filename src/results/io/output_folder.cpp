#include "io/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/faults.hpp"
#include "io/checkpoint_file.hpp"
#include "io/provenance.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProbe = ".writable";  // is made and removed: whether a folder can be written

/// Removes what `run` and `bem` write into a folder or one below it, but for the case and its origin.
void remove_results(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name :
       {"centre_line.csv", "crack.csv",      "crack_depths.csv",   "depth_line.csv",  "force_spectrum.csv",
        "geometry.json",   "history.csv",    "interface_slip.csv", "patch.csv",       "patch.pvd",
        "patch.vtp",       "patch_film.csv", "points_history.csv", "report.html",     "residual.csv",
        "residual.json",   "section.vtp",    "shakedown.json",     "streamlines.csv", "summary.json",
        "view.py"})
    fs::remove(folder / name, ignored);
  for (const char* body : {"rail", "wheel"})
    for (const char* name : {"{}.vtu", "{}_cross_section.csv", "{}_longitudinal_section.csv", "{}_slices.csv",
                             "{}_surface.vtp", "shakedown_{}.csv", "shakedown_{}_map.csv", "shakedown_{}_sliding.csv"})
      fs::remove(folder / fmt::format(fmt::runtime(name), body), ignored);
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string(); name.starts_with("patch_") && name.ends_with(".vtp"))
      frames.push_back(entry.path());
  for (const auto& frame : frames) fs::remove(frame, ignored);
}

// A run may go on elsewhere: what a device computes is the same but for rounding.
std::string without_device(std::string resolved) {
  constexpr const char* kKey = "\ndevice = ";  // of [run]; no other table has one
  if (const std::size_t at = resolved.find(kKey); at != std::string::npos)
    resolved.erase(at, resolved.find('\n', at + 1) - at);
  return resolved;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) throw EnvironmentError(fmt::format("cannot read the profile {}", file.string()));
  return std::move(bytes).str();
}

/// Profile files of the case, each once.
std::vector<fs::path> profile_files(const LoadedCase& loaded) {
  std::vector<std::string> names{loaded.spec.geometry.rail_profile, loaded.spec.geometry.wheel_profile};
  for (const LoadSpec& load : loaded.spec.loads) names.push_back(load.wheel_profile);
  std::vector<fs::path> out;
  for (const fs::path file : names) {
    const bool given = std::find(loaded.inputs.begin(), loaded.inputs.end(), file) != loaded.inputs.end();
    if (given && std::find(out.begin(), out.end(), file) == out.end()) out.push_back(file);
  }
  return out;
}

/// "wheel.csv", "wheel-2.csv", "wheel-3.csv", …
std::string numbered(const fs::path& file, int n) {
  const std::string name = file.filename().string();
  return n == 1 ? name : fmt::format("{}-{}{}", file.stem().string(), n, file.extension().string());
}

/// The spec with each profile file under another name.
template <class Name>
std::string renamed_case(const LoadedCase& loaded, Name&& name_of) {
  CaseSpec spec = loaded.spec;
  std::vector<std::string*> profiles{&spec.geometry.rail_profile, &spec.geometry.wheel_profile};
  for (LoadSpec& load : spec.loads) profiles.push_back(&load.wheel_profile);
  for (const fs::path& file : profile_files(loaded))
    for (std::string* profile : profiles)
      if (*profile == file.string()) *profile = name_of(file);
  return resolved_case(spec);
}

}  // namespace

FolderHold prepare_output_folder(const fs::path& folder, bool force, const std::function<bool()>& begun) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw EnvironmentError(fmt::format("cannot make the output folder {}: {}", folder.string(),
                                       error ? error.message() : "a file of this name already exists"),
                           "choose another with --out");
  FolderHold hold(folder, begun != nullptr);
  bool empty = true;  // but for what others that begin at this moment are still writing, or have left so
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    empty = empty && (is_part(entry->path().filename().string()) || entry->path().filename() == kProbe);
  if (error)
    throw EnvironmentError(fmt::format("cannot read the output folder {}: {}", folder.string(), error.message()));
  if (!empty && !(begun && begun()) && !force)  // asked after the look around: it may have come meanwhile
    throw CaseError(fmt::format("the output folder {} is not empty", folder.string()),
                    "choose another with --out, or overwrite files of the same name with --force");
  const fs::path probe = folder / kProbe;
  write_whole_file(probe, "");
  fs::remove(probe, error);
  return hold;
}

void clear_old_results(const fs::path& folder) {
  remove_results(folder);
  remove_checkpoints(folder);
  std::error_code ignored;
  std::vector<fs::path> parts;
  const auto is_reference = [](const std::string& name) { return name == kReferenceFolder || name == kSectionsFolder; };
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string();
        entry.is_directory(ignored) &&
        (name.starts_with(kPositionFolder) || is_reference(name) || name == kSeriesFolder))
      parts.push_back(entry.path());
  for (const auto& part : parts) {
    remove_results(part);
    if (is_reference(part.filename().string()))
      for (const char* name : {"case.toml", "case.original.toml", "provenance.json"}) fs::remove(part / name, ignored);
    if (fs::is_empty(part, ignored)) fs::remove(part, ignored);
  }
}

void require_apart(const fs::path& folder, const LoadedCase& loaded) {
  std::error_code ignored;
  for (const char* name : {"case.toml", "case.original.toml"})
    if (fs::equivalent(folder / name, loaded.file, ignored))
      throw CaseError(fmt::format("the results in {} would replace the case file itself", folder.string()),
                      "choose another folder with --out");
}

void write_origin(const fs::path& folder, const LoadedCase& loaded, const std::vector<std::string>& command_line,
                  int threads) {
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

void remove_parts(const fs::path& folder, PartsOf whom) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename().string();
        entry.is_regular_file(ignored) && (whom == PartsOf::anyone ? is_part(name) : is_abandoned_part(name)))
      found.push_back(entry.path());
  for (const auto& file : found) fs::remove(file, ignored);
}

std::string case_identity(const LoadedCase& loaded) { return sha256_of(without_device(case_by_content(loaded))); }

std::vector<std::string> table_origin(const LoadedCase& loaded) {
  return {fmt::format("RailStrata {}", version_text()),
          fmt::format("case: {} ({})", loaded.file.filename().string(), loaded.spec.title),
          "x from the axle in the rolling direction, y towards the field side; tractions act on the rail"};
}

std::vector<KeptInput> kept_inputs(const LoadedCase& loaded, const fs::path& folder) {
  std::vector<KeptInput> out;
  for (const fs::path& source : profile_files(loaded)) {
    const std::string bytes = bytes_of(source);
    for (int n = 1;; ++n) {
      const std::string kept = fmt::format("{}/{}", kInputsFolder, numbered(source, n));
      const bool taken =
          std::any_of(out.begin(), out.end(), [&](const KeptInput& other) { return other.kept == kept; });
      if (taken || (fs::exists(folder / kept) && bytes_of(folder / kept) != bytes)) continue;
      out.push_back({source, kept});
      break;
    }
  }
  return out;
}

void copy_inputs(const std::vector<KeptInput>& inputs, const fs::path& folder) {
  if (!inputs.empty()) make_folder(folder / kInputsFolder, Above::there);
  for (const KeptInput& input : inputs)
    if (!fs::exists(folder / input.kept)) write_whole_file(folder / input.kept, bytes_of(input.source));
}

std::string kept_case(const LoadedCase& loaded, const std::vector<KeptInput>& inputs) {
  return renamed_case(loaded, [&](const fs::path& file) {
    const auto at = std::find_if(inputs.begin(), inputs.end(), [&](const KeptInput& i) { return i.source == file; });
    return at == inputs.end() ? file.string() : at->kept;
  });
}

std::string case_by_content(const LoadedCase& loaded) {
  return renamed_case(loaded, [](const fs::path& file) { return sha256_of_file(file); });
}

}  // namespace railstrata
