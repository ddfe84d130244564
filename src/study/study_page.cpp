#include "study/study_page.hpp"

#include "io/output_file.hpp"
#include "report/page.hpp"
#include "study/study_report.hpp"

namespace railstrata {
namespace {

std::vector<StudyEntry> entries_of(const std::filesystem::path& out, const std::vector<StudyRow>& rows) {
  std::vector<StudyEntry> entries;
  for (const StudyRow& r : rows) {
    const StudyCase& c = *r.study_case;
    entries.push_back({c.group, c.name, c.engine, r.state, r.fault, out / c.folder, c.values, r.numbers});
  }
  return entries;
}

/// The tables of the page as files, for those who want to go on with them.
void write_table(const std::filesystem::path& file, const ReportTable& t) {
  std::string text;
  for (std::size_t k = 0; k < t.columns.size(); ++k)
    text += csv_cell(t.columns[k]) + (k + 1 < t.columns.size() ? "," : "\n");
  for (const auto& row : t.rows)
    for (std::size_t k = 0; k < row.size(); ++k)
      text += (row[k].is_number()   ? csv_cell(row[k].get<double>())
               : row[k].is_string() ? csv_cell(row[k].get<std::string>())
                                    : "") +
              (k + 1 < row.size() ? "," : "\n");
  write_whole_file(file, text);
}

}  // namespace

ReportVerdict write_study_page(const std::filesystem::path& page, const LoadedStudy& study, const Published& published,
                               const std::vector<StudyRow>& rows) {
  const std::filesystem::path out = page.parent_path();
  const Report report = study_report(study.spec, published, entries_of(out, rows));
  for (const ReportTable& t : report.tables)
    if (t.id == "published" || t.id == "claims") write_table(out / (t.id + ".csv"), t);
  write_whole_file(page, report_page(report));
  return verdict_of(report);
}

}  // namespace railstrata
