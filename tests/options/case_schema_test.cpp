#include "options/case_schema.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "options/option_table.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

TEST(CaseReference, ThePageInDocsIsTheOneTheProgramWrites) {
  std::ifstream file(source_dir() / "docs/case-reference.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), case_reference_markdown())
      << "write it again: ./railstrata info --schema --markdown > docs/case-reference.md";
}

TEST(CaseSchema, HasEveryOptionAndRefusesOthers) {
  const auto schema = nlohmann::json::parse(case_json_schema());
  EXPECT_EQ(schema["additionalProperties"], false);
  for (const OptionTable& table : case_tables()) {
    std::string path = "/properties/" + std::string(table.name);
    if (const auto dot = path.find('.'); dot != std::string::npos) path.replace(dot, 1, "/properties/");
    if (table.repeated) path += "/items";
    const auto& object = schema.at(nlohmann::json::json_pointer(path));
    EXPECT_EQ(object["additionalProperties"], false) << path;
    EXPECT_EQ(object["properties"].size(), table.options.size()) << path;
    for (const Option& option : table.options)
      EXPECT_TRUE(object["properties"].contains(option.key)) << path << option.key;
  }
}

}  // namespace
}  // namespace railstrata
