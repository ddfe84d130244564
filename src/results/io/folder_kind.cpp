#include "io/folder_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "io/checkpoint_file.hpp"
#include "record/escaped_text.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

bool has(const fs::path& folder, const char* name) {
  std::error_code error;
  return fs::exists(folder / name, error);
}

/// A folder of another kind than a result of one case, recognised by a file in it.
struct Kind {
  const char *file, *what, *remedy;
};
constexpr Kind kKinds[] = {
    {"study.csv", "this is a study",
     "its page is report.html in it; for one case give its folder, GROUP/CASE/fem or GROUP/CASE/bem below it"},
    {"sweep.csv", "this is a sweep",
     "its table is sweep.csv in it; for one of its cases: railstrata bem CASE --set KEY=VALUE"},
    {"creep_curve.csv", "this is a creep curve",
     "its table is creep_curve.csv in it; for a page on the case: railstrata bem CASE"},
    {"creep_table.csv", "this is a creep-force table",
     "its table is creep_table.csv in it; for a page on the case: railstrata bem CASE"},
    {"receptance.csv", "this is a receptance of the track",
     "its table is receptance.csv in it; for a page on the case: railstrata run CASE"},
    {"collective.csv", "this is a load collective",
     "its page is report.html; the folder shown_load has the load that it shows in full"},
    {"wear_loop.csv", "this is the wear of a load collective", "its page is report.html in it"},
    {"passes.csv", "these are passes over a yielding rail",
     "its tables are passes.csv and residual.csv in it; for a page on the case: railstrata bem CASE"},
    {"compare.json", "this is a comparison",
     "its picture is compare.svg; for a page give the two folders that it compares"}};

/// The first folder, by name, right below this one that holds a finished result; empty if none does.
fs::path result_below(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    if (has(entry->path(), "summary.json")) found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found.empty() ? fs::path() : found.front();
}

Diagnostic begun(const fs::path& folder) {
  const std::string word = shell_word(folder.string()), name = folder.string();
  if (fs::exists(checkpoint_file(folder)) || fs::exists(previous_checkpoint_file(folder)))
    return {"", fmt::format("{}: this run is not finished: it has a checkpoint but no summary.json", name),
            fmt::format("railstrata run --resume {}", word)};
  return {"", fmt::format("{}: this folder was begun and has no results yet", name),
          fmt::format("wait until it has ended; if it was stopped, start it again: {}", command_again(folder))};
}

}  // namespace

std::vector<std::string> command_line_of(const fs::path& folder) {
  std::ifstream in(folder / "provenance.json", std::ios::binary);
  const auto origin = nlohmann::json::parse(in, nullptr, false);
  std::vector<std::string> words;
  if (!origin.is_object() || !origin.contains("command_line") || !origin["command_line"].is_array()) return words;
  for (const auto& word : origin["command_line"])
    if (word.is_string()) words.push_back(word.get<std::string>());
  return words;
}

std::string command_again(const fs::path& folder) {
  const std::vector<std::string> words = command_line_of(folder);
  if (words.size() < 2) return fmt::format("railstrata run CASE --out {} --force", shell_word(folder.string()));
  std::string out = "railstrata";
  for (std::size_t i = 1; i < words.size(); ++i) out += " " + shell_word(words[i]);
  return std::find(words.begin(), words.end(), "--force") == words.end() ? out + " --force" : out;
}

Diagnostic no_result_here(const fs::path& folder) {
  const std::string name = folder.string(), word = shell_word(name);
  std::error_code error;
  if (!fs::exists(folder, error))
    return {"", fmt::format("{} is not a result folder: there is no such folder", name),
            "give a folder that `railstrata run` or `railstrata bem` has written"};
  if (!fs::is_directory(folder, error))
    return {"", fmt::format("{} is not a result folder: it is a file", name),
            "give a folder that `railstrata run` or `railstrata bem` has written"};
  for (const Kind& kind : kKinds)
    if (has(folder, kind.file))
      return {"", fmt::format("{}: {}, not the result of one case", name, kind.what), kind.remedy};
  if (has(folder, "rail.vtu") && !has(folder, "history.csv"))
    return {"", fmt::format("{}: these are meshes", name), "railstrata run CASE"};
  if (has(folder, "provenance.json") || has(folder, "checkpoint.h5")) return begun(folder);
  if (const fs::path below = result_below(folder); !below.empty())
    return {"", fmt::format("{} is not a result folder: it has no summary.json, but folders in it have one", name),
            fmt::format("give a folder that has one, for example {}", shell_word(below.string()))};
  return {"", fmt::format("{} is not a result folder: it has no summary.json", name),
          "give a folder that `railstrata run` or `railstrata bem` has written"};
}

}  // namespace railstrata
