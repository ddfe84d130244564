#pragma once
// Published numbers and statements that a study is held against: data beside the study, judged by the program from the
// study's table alone.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/engine.hpp"

namespace railstrata {

/// Where the study's answers come from: one column of the comparison.
struct AnswerColumn {
  std::string name;
  Engine engine = Engine::fem;
  std::string prefix;  ///< of the group's name: "paper_" takes "paper_layers" for "layers"; a group that has no such
                       ///< twin stands for itself
};

/// A number of the text. Ours is `column` of `given`; with `against`, its change from there in per cent; with
/// `engines`, finite elements against half-spaces in per cent.
struct PublishedNumber {
  std::string section, quantity, unit;
  std::string column, given, against, bound;
  std::string other, other_is, note;
  double value = 0, within = 0;  ///< agreement: |ours - value| at most this, in the number's unit
  double factor = 1;             ///< of the table's column into the unit
  bool engines = false;
  std::vector<std::string> only;  ///< columns it makes sense for; empty: all
};

/// A statement of the text as a test of the table.
struct PublishedClaim {
  std::string section, text, kind;
  std::string column, along, each, unit;
  double factor = 1, limit = 0;  ///< kind "above", "below": the limit, in the unit
  std::string given;             ///< of "above", "below": the case
  std::vector<std::string> groups;
  std::map<std::string, std::vector<std::string>> where;
};

struct Published {
  std::string source;
  std::vector<AnswerColumn> columns;
  std::vector<PublishedNumber> numbers;
  std::vector<PublishedClaim> claims;
};

/// Throws CaseError with the place of a mistake.
Published load_published(const std::filesystem::path& file);

/// The same from a text; `file` names it in messages.
Published parse_published(const std::string& text, const std::filesystem::path& file);

}  // namespace railstrata
