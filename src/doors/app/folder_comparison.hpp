#pragma once
// Two results, of either engine, on one grid: numbers and fields with their differences.
#include <filesystem>

#include "io/result_folder.hpp"
#include "result/compare.hpp"

namespace railstrata {

/// results/<folder A>-against-<folder B>
std::filesystem::path comparison_folder(const std::filesystem::path& a, const std::filesystem::path& b);

class FolderComparison {
 public:
  /// Differences are relative to B. Warns of doubts about either; throws CaseError for folders without results and for
  /// fields that do not compare.
  FolderComparison(const std::filesystem::path& folder_a, const std::filesystem::path& folder_b);
  /// compare.json, compare.csv, fields.csv and compare.svg.
  void write(const std::filesystem::path& out) const;
  /// The table, or compare.json, on standard output.
  void print(bool json) const;

 private:
  ResultFolder a_, b_;
  FieldComparison fields_;
};

}  // namespace railstrata
