#include "core/engine.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/body_id.hpp"

namespace railstrata {
namespace {

TEST(Engine, EveryWordNamesItsEngineAndNoOther) {
  EXPECT_EQ(engine_words(), (std::vector<std::string>{"fem", "bem", "sections"}));
  for (const EngineRow& row : kEngines) {
    EXPECT_EQ(engine_of(row.word), row.engine);
    EXPECT_TRUE(is_engine(row.word, row.engine));
    EXPECT_FALSE(row.title.empty());
  }
  EXPECT_FALSE(engine_of("").has_value());
  EXPECT_FALSE(engine_of("FEM").has_value());
  EXPECT_FALSE(is_engine("bem", Engine::fem));
}

TEST(Engine, JsonHoldsTheWordAndNoNumber) {
  EXPECT_EQ(nlohmann::json(Engine::fem).dump(), "\"fem\"");
  EXPECT_EQ((nlohmann::ordered_json{{"engine", Engine::bem}}.dump()), "{\"engine\":\"bem\"}");
}

TEST(BodyId, HasOneWordForEachBody) {
  EXPECT_STREQ(body_word(BodyId::rail), "rail");
  EXPECT_STREQ(body_word(BodyId::wheel), "wheel");
  EXPECT_EQ(kBodies.size(), 2u);
}

}  // namespace
}  // namespace railstrata
