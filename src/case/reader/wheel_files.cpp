#include "reader/wheel_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/faults.hpp"
#include "spec/case_spec.hpp"
#include "tables/column_words.hpp"
#include "tables/unit_table.hpp"
#include "text/text_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kListRemedy = "a list of wheels has the columns file and share [%]";

/// Where the text of a column goes: the reader asks for one.
Slot text_slot(CaseSpec& spec, std::size_t) { return &spec.title; }

/// Shares without a unit that add up to 100 are in per cent.
const Option kFile{"file", text_slot, ""}, kShare{"share", nullptr, "", dimension::kNumber, {0, 100, true}};

std::vector<WheelShare> in_list(const fs::path& list, const std::string& text) {
  constexpr double kClose = 0.005;
  UnitTableForm form{{}, {}, "a wheel", "file; share [%]"};
  for (const Option* option : {&kFile, &kShare}) {
    form.columns.push_back({option, option->key});
    for (const std::string_view word : words_of(option->key)) form.columns.push_back({option, word});
  }
  const UnitTable table = read_unit_table(text, list, form);
  std::vector<WheelShare> out;
  double sum = 0;
  for (const UnitTable::Row& row : table.rows) {
    WheelShare& wheel = out.emplace_back(WheelShare{{}, 1});
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      if (table.columns[k] == &kFile)
        wheel.file = (list.parent_path() / row.cells[k].text).lexically_normal();
      else
        wheel.share = *row.cells[k].number;
    std::error_code error;
    if (!fs::is_regular_file(wheel.file, error))
      refuse_in_table(list, row.line, fmt::format("no profile {}", wheel.file.string()),
                      "name a profile's file, relative to the folder of the list");
    sum += wheel.share;
  }
  const double whole = sum > 2 ? 100 : 1;
  if (table.has(kShare.key) && !(std::abs(sum / whole - 1) <= kClose))
    refuse_in_table(list, table.line, fmt::format("the shares add up to {:.4g} %, must be 100 %", 100 * sum / whole),
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
  const std::vector<std::string> names = column_names(text);
  const auto named = [&](std::string_view word) { return std::find(names.begin(), names.end(), word) != names.end(); };
  const std::vector<std::string_view>& words = words_of(kFile.key);
  return named(kFile.key) || std::any_of(words.begin(), words.end(), named);
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
