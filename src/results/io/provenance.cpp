#include "io/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <zlib.h>
#if __has_include(<hdf5.h>)  // a build may be without the room hdf5
#include <hdf5.h>
#endif
#include <toml++/toml.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
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
namespace {

// ---- SHA-256 [NIST FIPS 180-4]
constexpr std::size_t kBlock = 64;  // bytes
using Hash = std::array<std::uint32_t, 8>;

// First 32 bits of the fractional parts of the cube roots of the first 64 primes, sec. 4.2.2.
constexpr std::uint32_t kRound[kBlock] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
// From the square roots of the first eight primes, sec. 5.3.3.
constexpr Hash kStart = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};

std::uint32_t mixed(std::uint32_t x, int a, int b, int c) {
  return std::rotr(x, a) ^ std::rotr(x, b) ^ std::rotr(x, c);
}
std::uint32_t shifted(std::uint32_t x, int a, int b, int c) { return std::rotr(x, a) ^ std::rotr(x, b) ^ (x >> c); }

/// One block, sec. 6.2.2.
void add_block(Hash& hash, const unsigned char* block) {
  std::uint32_t w[kBlock];
  for (std::size_t t = 0; t < 16; ++t) {
    w[t] = 0;
    for (std::size_t k = 0; k < 4; ++k) w[t] = w[t] << 8 | block[4 * t + k];
  }
  for (std::size_t t = 16; t < kBlock; ++t)
    w[t] = shifted(w[t - 2], 17, 19, 10) + w[t - 7] + shifted(w[t - 15], 7, 18, 3) + w[t - 16];
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t t = 0; t < kBlock; ++t) {
    const std::uint32_t t1 = h + mixed(e, 6, 11, 25) + ((e & f) ^ (~e & g)) + kRound[t] + w[t];
    const std::uint32_t t2 = mixed(a, 2, 13, 22) + ((a & b) ^ (a & c) ^ (b & c));
    h = g;
    g = f;
    f = e;
    e = d + t1;
    d = c;
    c = b;
    b = a;
    a = t1 + t2;
  }
  const Hash change{a, b, c, d, e, f, g, h};
  for (std::size_t k = 0; k < hash.size(); ++k) hash[k] += change[k];
}

}  // namespace

std::string version_text() {
  const BuildInfo& b = build_info();
  return b.commit.empty() ? b.version : fmt::format("{} ({}{})", b.version, b.commit, b.dirty ? "+dirty" : "");
}

std::string commit_text() { return build_info().commit + (build_info().dirty ? "+dirty" : ""); }

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

std::string sha256_of(std::string_view bytes) {
  Hash hash = kStart;
  const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
  std::size_t left = bytes.size();
  for (; left >= kBlock; at += kBlock, left -= kBlock) add_block(hash, at);
  // the rest, a bit of one, zeros, and the length in bits: one or two blocks, sec. 5.1.1
  unsigned char last[2 * kBlock] = {};
  if (left > 0) std::memcpy(last, at, left);
  last[left] = 0x80;
  const std::size_t size = left + 9 > kBlock ? 2 * kBlock : kBlock;
  const std::uint64_t bits = 8 * std::uint64_t{bytes.size()};
  for (std::size_t k = 0; k < 8; ++k) last[size - 1 - k] = static_cast<unsigned char>(bits >> 8 * k);
  for (std::size_t k = 0; k < size; k += kBlock) add_block(hash, last + k);
  std::string out;
  for (const std::uint32_t word : hash) out += fmt::format("{:08x}", word);
  return out;
}

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
