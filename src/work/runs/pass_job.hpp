#pragma once
// Base of the jobs of both kinds of passes (runs/pass_folder.hpp).
#include <string>
#include <vector>

#include "passes/pass_files.hpp"
#include "runs/pass_folder.hpp"

namespace railstrata {

/// Names of files in such a folder.
inline constexpr const char *kPassTable = "passes.csv", *kPassState = "state.csv", *kPassSummary = "passes.json",
                            *kPressedProfile = "rail_profile.csv";

class PassJob : public CaseJob {
 protected:
  /// to_repeat: as of JobKind.
  PassJob(const char* to_repeat, LoadedCase loaded, const PassOrder& order, Control& control);
  /// Plastic strain of all rows is equivalent strain: folders of versions where it was another norm do not go on.
  std::string identity() const override { return CaseJob::identity() + " equivalent strain"; }
  void begin() override;
  std::vector<std::string> older_results() const override;
  bool write_page() override;

  /// Reports the progress of all wanted passes, the current one included.
  void report(int pass, double fraction) const;
  /// A pass that has ended; more: what the method adds.
  void report(const PassRow& row, const std::string& more) const;
  /// Warns of an equivalent plastic strain beyond small strains (material/strain_claim.hpp).
  void warn_of_large_strain(double strain) const;

  const PassOrder wanted_;
  std::string verdict_;  ///< for the page
};

}  // namespace railstrata
