#include "io/provenance.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

TEST(Provenance, Sha256OfAbcIsTheOneOfTheStandard) {  // FIPS 180-4, example "abc"
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  // lengths around the ends of blocks; the digest of all digests by Python's hashlib
  std::string all;
  for (const int n : {0, 3, 55, 56, 63, 64, 65, 119, 120, 1000}) {
    std::string bytes;
    for (int k = 0; k < n; ++k) bytes += static_cast<char>((7 * k + n) % 256);
    all += sha256_of(bytes);
  }
  EXPECT_EQ(sha256_of(all), "6f04da4c287b22df9679ecb8506df1b0cdf7f08de7fd92724a8757241aafb929");
}

TEST(Provenance, NamesEveryInputWithItsSha256AndTheCommandLine) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "input.txt";
  std::ofstream(file) << "abc";
  const auto json =
      nlohmann::json::parse(provenance_json({"railstrata", "run", "a.toml"}, {"mesh.element_size=2 mm"}, {file}, 3));
  EXPECT_EQ(json["inputs"][0]["file"], file.string());
  EXPECT_EQ(json["inputs"][0]["sha256"], sha256_of("abc"));
  EXPECT_EQ(json["command_line"][2], "a.toml");
  EXPECT_EQ(json["overrides"][0], "mesh.element_size=2 mm");
  EXPECT_EQ(json["threads"], 3);
  for (const char* key : {"version", "commit", "dirty", "compiler", "flags", "libraries", "cpu", "isa", "time_utc"})
    EXPECT_TRUE(json.contains(key)) << key;
}

TEST(Provenance, NamesTheCopiesThatAResultKeeps) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "input.txt";
  std::ofstream(file) << "abc";
  const auto json = nlohmann::json::parse(provenance_json({}, {}, {file}, 1, {"12ab", {{file, "inputs/w.csv"}}}));
  EXPECT_EQ(json["inputs"][0]["kept"], "inputs/w.csv");
  EXPECT_EQ(json["case_sha256"], "12ab");
  EXPECT_FALSE(nlohmann::json::parse(provenance_json({}, {}, {file}, 1)).contains("case_sha256"));
}

TEST(Provenance, AMissingInputIsAnEnvironmentError) { EXPECT_THROW(sha256_of_file("no/such/file"), EnvironmentError); }

}  // namespace
}  // namespace railstrata
