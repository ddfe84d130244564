#include "runs/pass_job.hpp"

#include <fmt/format.h>

#include <utility>

#include "io/output_folder.hpp"
#include "material/strain_claim.hpp"
#include "report/passes_page.hpp"
#include "runs/write_report.hpp"

namespace railstrata {

PassJob::PassJob(const char* to_repeat, LoadedCase loaded, const PassOrder& order, Control& control)
    : CaseJob({"passes", "identity.txt", to_repeat}, std::move(loaded), order, control), wanted_(order) {}

void PassJob::begin() {
  clear_old_results(folder());
  CaseJob::begin();
}

std::vector<std::string> PassJob::older_results() const {
  return {kPassTable,     kPassState,    kPassSummary, kPressedProfile, "report.html",
          "residual.csv", "profile.csv", "loops.csv",  "along.csv",     "section.vtp"};
}

bool PassJob::write_page() {
  const std::filesystem::path page = folder() / "report.html";
  return write_page_or_warn(page, control_, [&] {
    write_passes_page(page, {folder()});
    return WrittenPage{{true, verdict_}, {}};
  });
}

void PassJob::report(int pass, double fraction) const {
  control_.progress("passes", (pass - 1 + fraction) / wanted_.passes, pass);
}

void PassJob::report(const PassRow& row, const std::string& more) const {
  control_.info(
      "pass {}: accumulated {:.3g}, net {:.3g} at {:.2f} mm; residual stress {:.0f} MPa along, {:.0f} MPa across; {}",
      row.pass, row.largest.accumulated, row.largest.net, 1e3 * row.net_depth, 1e-6 * row.stress[0],
      1e-6 * row.stress[1], more);
}

void PassJob::warn_of_large_strain(double strain) const {
  if (const std::string words = strain_warning(strain); !words.empty()) control_.warn("{}", words);
}

}  // namespace railstrata
