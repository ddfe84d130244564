#include "io/kept_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/faults.hpp"
#include "io/provenance.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) throw EnvironmentError(fmt::format("cannot read the profile {}", file.string()));
  return std::move(bytes).str();
}

/// Profile files of the case, each once.
std::vector<fs::path> profile_files(const LoadedCase& loaded) {
  std::vector<fs::path> out;
  for (const std::string& name : {loaded.spec.geometry.rail_profile, loaded.spec.geometry.wheel_profile}) {
    const fs::path file = name;
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
  for (const fs::path& file : profile_files(loaded))
    for (std::string* profile : {&spec.geometry.rail_profile, &spec.geometry.wheel_profile})
      if (*profile == file.string()) *profile = name_of(file);
  return resolved_case(spec);
}

}  // namespace

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
