#pragma once
// Passes of wheels over a rail that yields, by the finite elements: every pass is a short roll of a new wheel.
//
//   put on     equilibrium of the wheel on the rail as earlier passes have left it
//   roll       `length`, with the creepage that gives the wanted traction
//   lift off   the plastic state of the steady stations is the section's; the rail at rest with it at every station has
//              the residual stress, and is what the next wheel is put on
//
// Measured from where the wheel is put on, in half-lengths a of Hertz's ellipse: 12 are rolled, stations from 6 to 8
// are steady. The wheel's own indentation at the start reaches to some 2 a, traction at a given creepage is built up
// within 3, and behind the load residual stress does not change from 4 on; RolledPass::uneven measures how steady they
// are.
//
// Wheels that wander stand elsewhere across one rail: its mesh is that of the case's own place, with a fine zone as
// much wider as the contact point moves on it.
#include <filesystem>
#include <optional>

#include "passes/rolled_pass_files.hpp"
#include "runs/solve_fem.hpp"

namespace railstrata {

class RolledPasses {
 public:
  /// spec: with run.plasticity; length: m, rolled in a pass, 0: chosen. Throws CaseError: what passes do not take.
  RolledPasses(const CaseSpec& spec, std::filesystem::path folder, double length = 0);

  const PassRoll& roll() const { return roll_; }

  /// The next pass; the series advances. None if it was stopped on the way. Throws as solve_fem.
  struct Pass : RolledPass {
    std::vector<PassLoop> loops;
  };
  std::optional<Pass> next(RolledSeries& series, const RunObserver& observer, const FemOptions& options,
                           std::optional<RunState> begun = {}) const;

 private:
  Model model_of(int pass, double creepage_shift) const;
  /// The case of a pass, its wheel in its place and with its traction.
  CaseSpec case_of(int pass) const;

  std::filesystem::path folder_;
  PassRoll roll_;
  CaseSpec spec_;
  Model base_;
};

}  // namespace railstrata
