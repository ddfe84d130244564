#pragma once
// A result folder read back: what `run` and `bem` wrote.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "contact/contact_field.hpp"
#include "result/summary.hpp"

namespace railstrata {

struct ResultFolder {  // NOLINT(bugprone-exception-escape): the move of json is declared not to throw, and does not
  std::filesystem::path folder;
  std::string title;
  std::string engine;                 ///< its word, as it stands in the file
  nlohmann::json summary;             ///< summary.json
  ContactField field;                 ///< patch.csv; of several patches the first
  std::vector<ContactField> further;  ///< the others

  /// A number of the summary by its path ("/contact/p_max_Pa"); NaN if it is null or not there.
  double number(const std::string& path) const;
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

}  // namespace railstrata
