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

/// What follows them, whether there is somebody or not.
class PassTeller {
 public:
  explicit PassTeller(const PassFolderObserver& observer) : observer_(observer) {}
  RunWishes wishes() const { return observer_.wishes ? observer_.wishes() : RunWishes{}; }
  void info(const std::string& text) const;
  void warn(const std::string& text) const;
  void going(int pass, double fraction) const;
  void passed() const;
  /// Warns of an equivalent plastic strain beyond small strains (material/strain_claim.hpp).
  void warn_of_large_strain(double strain) const;
  /// report.html, by the observer's way or with a warning where it fails.
  void write_page(const PassOrder& order, const std::string& verdict) const;
  const PassFolderObserver& observer() const { return observer_; }

 private:
  const PassFolderObserver& observer_;
};

/// Takes older files of passes away; writes origin and identity.
void begin_pass_folder(const LoadedCase& loaded, const PassOrder& order, const std::string& identity);

/// Throws CaseError unless the folder holds passes of this identity. by: " by finite elements"; what: to be given
/// again.
void require_same_passes(const PassOrder& order, const std::string& identity, const std::string& by,
                         const std::string& what);

}  // namespace railstrata
