#include "app/write_page.hpp"

#include <spdlog/spdlog.h>

#include <string>

#include "core/faults.hpp"

namespace railstrata {

bool write_page_or_warn(const std::filesystem::path& page, const std::function<WrittenPage()>& write) {
  try {
    const WrittenPage written = write();
    log_page(written);
    spdlog::info("everything on one page: {}", page.string());
    return written.verdict.ok;
  } catch (const CaseError& e) {
    spdlog::warn("no report: {}", e.what());
  } catch (const EnvironmentError& e) {
    spdlog::warn("no report: {}{}{}", e.what(), e.remedy.empty() ? "" : "\n    remedy: ", e.remedy);
  }
  return true;
}

void log_page(const WrittenPage& page) {
  for (const std::string& note : page.notes) spdlog::warn("{}", note);
  spdlog::log(page.verdict.ok ? spdlog::level::info : spdlog::level::warn, "verdict of the page: {}",
              page.verdict.text);
}

bool add_report(const std::filesystem::path& folder) {
  const std::filesystem::path page = folder / "report.html";
  return write_page_or_warn(page, [&] { return write_report(page, {folder}, true); });
}

}  // namespace railstrata
