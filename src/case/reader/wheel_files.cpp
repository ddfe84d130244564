#include "reader/wheel_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "tables/unit_table.hpp"
#include "text/text_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kListRemedy = "a list of wheels has the columns file and share [%]";

std::string bare(std::string_view text) { return std::string(trimmed(text, " \t\r\"")); }

struct ListLine {
  int number = 0;
  std::vector<std::string> cells;
};

/// Lines with something in them; the first one is that of the names.
std::vector<ListLine> lines_of(const std::string& text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::istringstream stream(text.starts_with(kMark) ? text.substr(kMark.size()) : text);
  std::vector<ListLine> out;
  char separator = 0;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    if (bare(line).empty()) continue;
    if (separator == 0)
      separator = line.find(';') != std::string::npos ? ';' : line.find('\t') != std::string::npos ? '\t' : ',';
    ListLine& added = out.emplace_back();
    added.number = number;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, separator);) added.cells.push_back(bare(cell));
  }
  return out;
}

std::optional<std::size_t> column_of(const ListLine& names, std::string_view wanted) {
  for (std::size_t k = 0; k < names.cells.size(); ++k)
    if (names.cells[k] == wanted || names.cells[k].starts_with(std::string(wanted) + " ")) return k;
  return std::nullopt;
}

double share_in(const fs::path& list, const ListLine& line, std::size_t column) {
  std::string text = column < line.cells.size() ? line.cells[column] : "";
  std::replace(text.begin(), text.end(), ',', '.');
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(value > 0 && value <= 100))
    refuse_in_table(list, line.number, fmt::format("share \"{}\": must be a number above 0 and at most 100", text),
                    "give the share of the passages in per cent, or leave the column out for equal shares");
  return value;
}

std::vector<WheelShare> in_list(const fs::path& list, const std::string& text) {
  constexpr double kAll = 100, kClose = 0.5;  // per cent
  const std::vector<ListLine> lines = lines_of(text);
  const std::size_t file = *column_of(lines.front(), "file");
  const std::optional<std::size_t> share = column_of(lines.front(), "share");
  std::vector<WheelShare> out;
  double sum = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const ListLine& line = lines[i];
    const std::string name = file < line.cells.size() ? line.cells[file] : "";
    std::error_code error;
    const fs::path found = (list.parent_path() / name).lexically_normal();
    if (name.empty() || !fs::is_regular_file(found, error))
      refuse_in_table(list, line.number, fmt::format("no profile \"{}\" (looked for {})", name, found.string()),
                      "name a profile's file, relative to the folder of the list");
    out.push_back({found, share ? share_in(list, line, *share) : 1});
    sum += out.back().share;
  }
  if (out.empty()) refuse_in_table(list, lines.front().number, "lists no wheels", kListRemedy);
  if (share && std::abs(sum - kAll) > kClose)
    refuse_in_table(list, lines.front().number, fmt::format("the shares add up to {:.4g} %, must be 100 %", sum),
                    "correct them, or leave the column share out for equal shares");
  for (WheelShare& wheel : out) wheel.share /= sum;
  return out;
}

bool may_be_profile(const fs::path& file) {
  constexpr std::array kEndings{".csv", ".txt", ".dat", ".prw", ".whl"};
  const std::string ending = file.extension().string();
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end() &&
         !file.filename().string().starts_with('.');
}

std::string text_of(const fs::path& file) { return read_text_file(file, kListRemedy); }

}  // namespace

bool lists_wheels(const std::string& text) {
  const std::vector<ListLine> lines = lines_of(text);
  return !lines.empty() && column_of(lines.front(), "file");
}

std::vector<WheelShare> measured_wheels(const fs::path& from) {
  if (!fs::is_directory(from)) return in_list(from, text_of(from));
  std::vector<WheelShare> out;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(from, error))
    if (entry.is_regular_file(error) && may_be_profile(entry.path())) out.push_back({entry.path(), 1});
  std::sort(out.begin(), out.end(), [](const WheelShare& a, const WheelShare& b) { return a.file < b.file; });
  for (const WheelShare& wheel : out)
    if (wheel.file.extension() == ".csv")
      if (const std::string text = text_of(wheel.file); lists_wheels(text)) return in_list(wheel.file, text);
  if (out.empty())
    throw CaseError("the folder has no profiles",
                    "put files ending in .csv, .txt, .dat, .prw or .whl into it, or a list with the columns file and "
                    "share [%]",
                    from.string());
  for (WheelShare& wheel : out) wheel.share = 1 / static_cast<double>(out.size());
  return out;
}

}  // namespace railstrata
