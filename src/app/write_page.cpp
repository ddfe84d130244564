#include "app/write_page.hpp"

#include <spdlog/spdlog.h>

#include <string>

#include "core/faults.hpp"
#include "runs/write_report.hpp"

namespace railstrata {

void write_page_or_warn(const std::filesystem::path& page, const std::function<void()>& write) {
  try {
    write();
    spdlog::info("everything on one page: {}", page.string());
  } catch (const CaseError& e) {
    spdlog::warn("no report: {}", e.what());
  } catch (const EnvironmentError& e) {
    spdlog::warn("no report: {}{}{}", e.what(), e.remedy.empty() ? "" : "\n    remedy: ", e.remedy);
  }
}

void add_report(const std::filesystem::path& folder) {
  const std::filesystem::path page = folder / "report.html";
  write_page_or_warn(page, [&] {
    for (const std::string& note : write_report(page, {folder}, true)) spdlog::warn("{}", note);
  });
}

}  // namespace railstrata
