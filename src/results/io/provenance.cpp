#include "io/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/faults.hpp"
#include "core/simd.hpp"
#include "record/json.hpp"
#include "record/this_process.hpp"

namespace railstrata {

std::string version_text() {
  const BuildInfo& b = build_info();
  return b.commit.empty() ? b.version : fmt::format("{} ({}{})", b.version, b.commit, b.dirty ? "+dirty" : "");
}

std::string commit_text() { return build_info().commit + (build_info().dirty ? "+dirty" : ""); }

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) throw EnvironmentError(fmt::format("cannot read {}", file.string()));
  return sha256_of(bytes.str());
}

std::string provenance_json(const std::vector<std::string>& command_line, const std::vector<std::string>& overrides,
                            const std::vector<std::filesystem::path>& inputs, int threads, const KeptOrigin& kept) {
  using Json = nlohmann::ordered_json;
  const BuildInfo& build = build_info();
  Json libraries, files = Json::array();
  for (const auto& [name, version] : library_versions()) libraries[name] = version;
  for (const auto& file : inputs) {
    files.push_back(
        {{"file", std::filesystem::absolute(file).lexically_normal().string()}, {"sha256", sha256_of_file(file)}});
    for (const auto& [source, copy] : kept.copies)
      if (source == file) files.back()["kept"] = copy;
  }
  Json all{{"program", "RailStrata"},
           {"version", build.version},
           {"commit", build.commit.empty() ? Json(nullptr) : Json(build.commit)},
           {"dirty", build.dirty},
           {"compiler", build.compiler},
           {"flags", build.flags},
           {"build_type", build.build_type},
           {"libraries", libraries},
           {"cpu", cpu_name()},
           {"isa", instruction_set()},
           {"cores", std::thread::hardware_concurrency()},
           {"threads", threads},
           {"host", host_name()},
           {"command_line", command_line},
           {"overrides", overrides},
           {"inputs", files},
           {"time_utc", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}};
  if (!kept.case_sha256.empty()) all["case_sha256"] = kept.case_sha256;
  return json_text(all, 2) + "\n";
}

}  // namespace railstrata
