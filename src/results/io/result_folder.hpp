#pragma once
// A result folder read back: what `run` and `bem` wrote, and reasons to doubt it although its files can be read.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "contact/contact_field.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// A number or a text of a JSON object by its path ("/contact/p_max_Pa"); NaN or empty if it is something else or not
/// there.
double number_at(const nlohmann::json& object, const std::string& path);
std::string text_at(const nlohmann::json& object, const std::string& path);
/// The objects of a list; none where it is something else.
std::vector<nlohmann::json> objects_of(const nlohmann::json& object, const char* list);

struct ResultFolder {  // NOLINT(bugprone-exception-escape): the move of json is declared not to throw, and does not
  std::filesystem::path folder;
  std::string title;
  std::string engine;                 ///< its word, as it stands in the file
  nlohmann::json summary;             ///< summary.json
  ContactField field;                 ///< patch.csv; of several patches the first
  std::vector<ContactField> further;  ///< the others

  double number(const std::string& path) const { return number_at(summary, path); }
};

/// A check, as stored in summary.json.
struct KeptCheck : Check {
  bool said_ok = false;  ///< `ok` in the file
};

/// The checks of summary.json. One holds if its `ok` is true and its value is within its limit.
std::vector<KeptCheck> checks_of(const nlohmann::json& summary);

/// Throws CaseError when the folder is not there, holds no summary.json or patch.csv, or they are not as this program
/// writes them.
ResultFolder read_result_folder(const std::filesystem::path& folder);

/// The same from the texts of the two files; `folder` names them in messages.
ResultFolder parse_results(const std::string& summary, const std::string& patch, const std::filesystem::path& folder);

/// name: "case_edited", "other_version" or "summary_contradicted"; `grave`: the page must not call such a result sound.
struct ResultDoubt {
  std::string name, text;
  bool grave = false;
};

/// By provenance.json: another version of the program wrote the result; case.toml is not the one of the run (its
/// SHA-256 differs); summary.json marks a check as holding whose value is beyond its limit, or has other largest
/// tractions or another normal force than patch.csv. Folders from before 0.2.0 do not have that hash and are not asked
/// for it. A position_<mm> folder has both files in the folder it stands in.
std::vector<ResultDoubt> result_doubts(const ResultFolder& result);

}  // namespace railstrata
