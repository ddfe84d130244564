#pragma once
// What both kinds of passes in a folder (runs/pass_folder.hpp) share.
#include <string>

#include "runs/pass_folder.hpp"

namespace railstrata {

/// Names of files in such a folder.
inline constexpr const char *kPassTable = "passes.csv", *kPassState = "state.csv", *kPassIdentity = "identity.txt",
                            *kPassSummary = "passes.json", *kPassPage = "report.html";

/// "1 pass", "20 passes"
std::string passes_text(int passes);

/// Warns of an equivalent plastic strain beyond small strains (material/strain_claim.hpp).
void warn_of_large_strain(double strain, const Control& control);

/// How far all wanted passes are, with the one under way.
void report_passes(const PassOrder& order, int pass, double fraction, const Control& control);

/// report.html if it is wanted; what fails is warned of.
void write_pass_page(const PassOrder& order, const std::string& verdict, const Control& control);

/// Takes older files of passes away; writes origin and identity.
void begin_pass_folder(const LoadedCase& loaded, const PassOrder& order, const std::string& identity);

/// Throws CaseError unless the folder holds passes of this identity. by: " by finite elements"; what: to be given
/// again.
void require_same_passes(const PassOrder& order, const std::string& identity, const std::string& by,
                         const std::string& what);

}  // namespace railstrata
