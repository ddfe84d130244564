#pragma once
// Where a result comes from: everything needed to make it again, as provenance.json.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace railstrata {

/// Written by cmake/write_build_info.cmake at every build.
struct BuildInfo {
  std::string version, commit;  ///< commit is empty outside a git checkout
  bool dirty = false;           ///< the checkout had uncommitted changes
  std::string compiler, flags, build_type;
  std::vector<std::pair<std::string, std::string>> parts;  ///< optional ones: there, or what to install
};
const BuildInfo& build_info();

/// "0.1.0 (1a2b3c4d5e6f+dirty)"
std::string version_text();

/// The commit a summary names, "+dirty" if the sources had changes.
std::string commit_text();

/// Name and version of every library linked.
std::vector<std::pair<std::string, std::string>> library_versions();

/// SHA-256 in hexadecimal [FIPS 180-4]. The file's: throws EnvironmentError if it cannot be read.
std::string sha256_of(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& file);

/// Inputs kept in a result folder: hash of the case, copies of files.
struct KeptOrigin {
  std::string case_sha256;                                            ///< of case.toml there; empty: there is none
  std::vector<std::pair<std::filesystem::path, std::string>> copies;  ///< an input file and its copy in the folder
};

/// The text of provenance.json: program, build, machine, threads, command line, overrides, time (UTC, ISO 8601), the
/// SHA-256 of every input file with the name of its copy ("kept"), and that of case.toml ("case_sha256").
std::string provenance_json(const std::vector<std::string>& command_line, const std::vector<std::string>& overrides,
                            const std::vector<std::filesystem::path>& inputs, int threads, const KeptOrigin& kept = {});

}  // namespace railstrata
