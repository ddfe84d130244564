#include "study/study_page.hpp"

#include "record/output_file.hpp"
#include "report/page.hpp"
#include "study/study_report.hpp"

namespace railstrata {
namespace {

/// The tables of the page as files, for those who want to go on with them.
void write_table(const std::filesystem::path& file, const ReportTable& t) {
  std::string text = csv_line({t.columns.begin(), t.columns.end()});
  for (const auto& row : t.rows) text += csv_line(row);
  write_whole_file(file, text);
}

}  // namespace

ReportVerdict write_study_page(const std::filesystem::path& page, const LoadedStudy& study, const Published& published,
                               std::vector<CaseRow> rows) {
  const std::filesystem::path out = page.parent_path();
  for (CaseRow& row : rows) row.folder = out / row.folder;
  const Report report = study_report(study.spec, published, rows);
  for (const ReportTable& t : report.tables)
    if (t.id == "published" || t.id == "claims") write_table(out / (t.id + ".csv"), t);
  write_whole_file(page, report_page(report));
  return verdict_of(report);
}

}  // namespace railstrata
