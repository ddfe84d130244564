#include "runs/pass_folder_parts.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "core/faults.hpp"
#include "io/output_file.hpp"
#include "material/strain_claim.hpp"
#include "report/passes_page.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
}  // namespace

std::string passes_text(int passes) { return fmt::format("{} {}", passes, passes == 1 ? "pass" : "passes"); }

void warn_of_large_strain(double strain, const Control& control) {
  if (const std::string words = strain_words(strain); !words.empty()) control.warn("{}", words);
}

void report_passes(const PassOrder& order, int pass, double fraction, const Control& control) {
  control.progress("passes", (pass - 1 + fraction) / order.passes, pass);
}

void write_pass_page(const PassOrder& order, const std::string& verdict, const Control& control) {
  if (!order.page) return;
  const fs::path page = order.folder / kPassPage;
  write_page_or_warn(page, control, [&] {
    write_passes_page(page, {order.folder});
    return WrittenPage{{true, verdict}, {}};
  });
}

void begin_pass_folder(const LoadedCase& loaded, const PassOrder& order, const std::string& identity) {
  clear_old_results(order.folder);
  for (const char* name : {kPassTable, kPassState, kPassSummary, kPassPage, "residual.csv", "profile.csv", "loops.csv",
                           "along.csv", "section.vtp"})
    fs::remove(order.folder / name);
  write_origin(order.folder, loaded, order.command.command_line, order.command.threads);
  write_whole_file(order.folder / kPassIdentity, identity);
}

void require_same_passes(const PassOrder& order, const std::string& identity, const std::string& by,
                         const std::string& what) {
  std::ifstream in(order.folder / kPassIdentity, std::ios::binary);
  if (std::string(std::istreambuf_iterator<char>(in), {}) != identity)
    throw CaseError(fmt::format("{}: no passes of this very case{}", order.folder.string(), by),
                    fmt::format("give the case, {} of its beginning, or begin another folder", what));
}

}  // namespace railstrata
