#include <fmt/format.h>
#include <zlib.h>
#if __has_include(<hdf5.h>)  // a build may be without the room hdf5
#include <hdf5.h>
#endif

#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "io/provenance.hpp"

namespace railstrata {

std::vector<std::pair<std::string, std::string>> library_versions() {
  const auto dotted = [](int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); };
  return {
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
#ifdef H5_VERS_MAJOR
      {"hdf5", dotted(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
#endif
      {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"zlib", zlibVersion()}};
}

}  // namespace railstrata
