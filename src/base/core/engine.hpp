#pragma once
// The engines that solve a case, and the words for them: in result files, study files and commands, and for people.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace railstrata {

/// Cheapest first: a study computes its cases in this order.
enum class Engine { bem, sections, fem };

struct EngineRow {
  Engine engine;
  std::string_view word;     ///< in files and options
  std::string_view title;    ///< for people
  std::string_view command;  ///< that solves a case with it
  std::string_view about;
};

/// All engines, in the order of lists on screen.
inline constexpr std::array kEngines{
    EngineRow{Engine::fem, "fem", "finite elements", "run", "explicit rolling of two meshed bodies"},
    EngineRow{Engine::bem, "bem", "half-space", "bem", "layered half-spaces, no meshes"},
    EngineRow{Engine::sections, "sections", "sections", "bem", "rail and wheel with their sections, bem.bodies"}};

constexpr const EngineRow& row_of(Engine engine) {
  for (const EngineRow& row : kEngines)
    if (row.engine == engine) return row;
  return kEngines.front();
}
constexpr std::string_view engine_word(Engine engine) { return row_of(engine).word; }
constexpr std::string_view engine_title(Engine engine) { return row_of(engine).title; }

/// The engine that a word of a file or an option names.
constexpr std::optional<Engine> engine_of(std::string_view word) {
  for (const EngineRow& row : kEngines)
    if (row.word == word) return row.engine;
  return {};
}
inline std::vector<std::string> engine_words() {
  std::vector<std::string> out;
  for (const EngineRow& row : kEngines) out.emplace_back(row.word);
  return out;
}
/// Whether a word read from a result is that of an engine.
constexpr bool is_engine(std::string_view word, Engine engine) { return word == engine_word(engine); }

/// The engine's word, in any JSON type.
template <class Json>
void to_json(Json& json, const Engine& engine) {
  json = engine_word(engine);
}

}  // namespace railstrata
