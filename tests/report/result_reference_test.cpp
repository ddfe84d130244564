#include "report/result_reference.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/summary_json.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const std::string& file) {
  std::ifstream in(source_dir() / file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The keys of an object that are among `known`, in its order: numbers that are new since then are no matter.
std::string keys_among(const Json& object, const std::string& known) {
  std::string out;
  for (const auto& [key, value] : object.items())
    if ((" " + known).find(" " + key + " ") != std::string::npos) out += key + " ";
  return out;
}

void expect_keys(const Json& object, const std::string& known) { EXPECT_EQ(keys_among(object, known), known); }

TEST(ResultsReference, ThePageInDocsIsTheOneTheProgramWrites) {
  EXPECT_EQ(text_of("docs/results-reference.md"), results_reference_markdown())
      << "write it again: ./railstrata info --schema --results --markdown > docs/results-reference.md";
}

// Scripts and recorded results read these keys; new ones may stand between them.
TEST(SummaryJson, KeepsItsKeys) {
  Summary s;
  s.rail.surface = StressPair{{1, 2, 3, 4}, {5, 6, 7, 8}};
  const Json j = summary_json(s);
  expect_keys(j, "title position_m contact stress energy run checks warnings ");
  expect_keys(j["contact"],
              "p_max_Pa q_max_Pa patch_length_m patch_width_m patch_area_m2 slip_area_fraction F_x_N F_y_N F_z_N "
              "contact_angle_rad normal_force_N lateral_force_N creepage_x creepage_y spin_per_m approach_m "
              "penetration_max_m p_max_scatter ");
  expect_keys(j["stress"], "rail wheel ");
  expect_keys(j["stress"]["wheel"], "surface subsurface layer interface matrix ");
  EXPECT_EQ(j["stress"]["rail"]["surface"].dump(),
            R"({"von_mises_max":{"value_Pa":1.0,"x_m":2.0,"y_m":3.0,"depth_m":4.0,"error_Pa":null},)"
            R"("sigma1_max":{"value_Pa":5.0,"x_m":6.0,"y_m":7.0,"depth_m":8.0,"error_Pa":null}})");
  expect_keys(j["energy"], "closure hourglass_share ");
  expect_keys(j["run"],
              "engine wall_s preload_wall_s output_wall_s elements nodes steps dt_s stable_step_s unscaled_step_s "
              "added_mass_kg element_steps_per_s threads peak_memory_bytes commit ");
}

TEST(SummaryJson, WritesCountsAsWholeNumbersAndWhatDoesNotApplyAsNull) {
  Summary s;
  s.run.elements = 12;
  const Json j = summary_json(s);
  EXPECT_EQ(j["run"]["elements"].dump(), "12");
  EXPECT_TRUE(j["contact"]["F_x_N"].is_null());
  EXPECT_TRUE(j["stress"]["rail"]["layer"].is_null());
}

TEST(ResultsReference, ForProgramsHasTheLimitsOfTheEnginesAgreement) {
  const Json checks = results_reference_json()["checks"];
  std::vector<std::string> keys;
  for (const Json& c : checks)
    if (c["kind"] == "engines") {
      keys.push_back(c["key"]);
      EXPECT_TRUE(c["fem_limit"].is_number()) << c;
    }
  EXPECT_EQ(keys, (std::vector<std::string>{"p_max", "patch_length", "q_max", "von_mises_below_surface"}));
}

}  // namespace
}  // namespace railstrata
