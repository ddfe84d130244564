#pragma once
// A series of passes by the stationary method on one grid, pass after pass or over jumps.
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passes/pass_runner.hpp"
#include "passes/pass_series.hpp"

namespace railstrata {

/// The elastic contacts of a series.
struct SeriesContacts {
  std::vector<BemResult> solutions;             ///< as of rail_passes
  std::vector<double> tractions;                ///< F_x over F_z of each
  std::unique_ptr<FollowingContact> following;  ///< null where the pressure is that of the elastic bodies
};

class SteadySeries {
 public:
  /// Called while it goes on.
  struct Listener {
    std::function<void(int pass)> begins;
    std::function<void(const PassRow& row, const FollowedPass& pass)> ends;
    std::function<void(const std::string& text)> says;
  };

  /// Throws CaseError as rail_passes. listener: may be empty.
  SteadySeries(const CaseSpec& spec, SeriesContacts contacts, Listener listener, const Control* control);

  const RailPasses& rail() const { return runner_.rail(); }
  const SteadyBody& body() const { return runner_.body(); }
  const SteadyGrid& grid() const { return rail().grid; }
  const PassSeries& series() const { return series_; }
  /// Strain of the contact of the last pass.
  const Field& strain() const { return runner_.strain(); }
  int passes() const { return series_.state.passes; }
  /// Of the last pass that was computed here; none yet.
  const std::optional<PassResult>& last() const { return last_; }
  const PassRow& last_row() const { return last_row_; }
  /// All passes have converged.
  bool settled() const { return settled_; }

  /// Goes on from the files of another call (passes/pass_files.hpp). Throws as read_pass_series.
  void resume(const std::filesystem::path& state, const std::filesystem::path& table);
  /// A pass, or where passes are jumped over a round, or a jump and the rounds behind it: what is given up or taken
  /// back as a whole. wanted: passes at the end. False: given up.
  bool step(int wanted);
  /// The next step may be the last one.
  bool nearly(int wanted) const { return passes() + series_.cycle >= wanted; }

 private:
  /// What a jump may have to be taken back to.
  struct Kept {
    PassSeries series;
    std::optional<PassResult> last;
    PassRow row;
    PassRunner::Place place;
    Field strain;
    bool settled;
  };
  Kept keep_all() const;
  void take_back(const Kept& kept);
  PassRunner::Place place_of(int pass) const;
  bool one_pass();
  std::optional<std::vector<double>> round();
  std::optional<std::vector<double>> change_in_round(const std::vector<double>& history);
  bool jump(int rounds);
  void keep(PassRow row, const FollowedPass& pass);
  void say(const std::string& text) const;

  CaseSpec spec_;
  std::vector<double> tractions_;
  std::unique_ptr<FollowingContact> following_;
  Listener listener_;
  PassRunner runner_;
  PassSeries series_;
  std::optional<PassResult> last_;
  PassRow last_row_;
  bool settled_ = true;
};

}  // namespace railstrata
