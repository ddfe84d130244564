#include "bridge/functions.hpp"
#include "bridge/patches.hpp"
#include "io/result_folder.hpp"
#include "record/csv.hpp"
#include "report/passes_page.hpp"
#include "runs/write_report.hpp"

namespace railstrata::bridge {
namespace {

void read_folder(Call& call) {
  const auto found = std::make_shared<ResultFolder>(read_result_folder(call.text("folder")));
  call.answer["summary"] = Json(found->summary);
  call.answer["patches"] = Json::array({patch_of(found->field)});
  for (const ContactField& field : found->further) call.answer["patches"].push_back(patch_of(field));
  call.make(found);
}

/// The columns of a CSV file of a result folder, by name.
void read_table(Call& call) {
  const auto found = std::make_shared<CsvTable>(read_csv(call.text("file")));
  Json& columns = call.answer["columns"] = Json::object();
  for (const CsvColumn& c : found->columns) columns[c.name] = Call::view(c.values.data(), {c.values.size()});
  call.make(found);
}

std::vector<std::filesystem::path> folders_of(const Call& call) {
  const std::vector<std::string> all = call.texts("folders");
  return {all.begin(), all.end()};
}

void report_page(Call& call) {
  call.answer["notes"] = write_report(call.text("page"), folders_of(call), call.flag("reference")).notes;
}

void passes_page(Call& call) { write_passes_page(call.text("page"), folders_of(call)); }

}  // namespace

Functions folder_functions() {
  return {{"read_result_folder", read_folder},
          {"read_table", read_table},
          {"write_report", report_page},
          {"write_passes_page", passes_page}};
}

}  // namespace railstrata::bridge
