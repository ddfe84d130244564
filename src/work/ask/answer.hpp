#pragma once
// One question, one answer: what half-space theory says of a case. Nothing is written or printed here.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "bem/transient.hpp"
#include "core/control.hpp"
#include "fatigue/crack_summary.hpp"
#include "fatigue/rail_damage.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "result/summary.hpp"
#include "result/transient_row.hpp"

namespace railstrata {

/// What is wanted besides the contact and the wear of its surface. What is not wanted costs nothing and is empty in the
/// answer.
struct Wanted {
  bool rail = true, wheel = true;  ///< their largest stresses
  /// Everything that decides whether it lasts, together: load factors, layers, fatigue and the largest stresses of the
  /// bodies that run.judged names and whose strengths the case gives.
  bool shakedown = true;
  bool single_track = false;  ///< with shakedown: the limit for traffic on one line, in some seconds
  bool planes = true;         ///< with shakedown: the critical planes of fatigue
  bool maps = false;          ///< with shakedown: the limits over traction
  bool other_fits = false;    ///< error bars contain what profiles from files leave open (ask/profile_errors.hpp)
  bool crack = true;          ///< of the case, if it has one
  bool life = true;           ///< of the rail through life.until if all wheels are this one; not of a case with loads
};
inline constexpr Wanted kContactAlone{.rail = false,
                                      .wheel = false,
                                      .shakedown = false,
                                      .single_track = false,
                                      .maps = false,
                                      .crack = false,
                                      .life = false};

/// How long the rail of a case lasts if all wheels are its one; of what how it is answered. Whoever asks gives it:
/// life_of_wheels (clock/wheel_life.hpp), which itself asks for contacts.
using LifeOf = std::function<LifeSummary(const CaseSpec& spec, const BemOptions& bem)>;
/// The same for cases with files in a folder.
using LifeOfFolder = LifeOf (*)(std::filesystem::path folder, const Control* control);

/// How it is answered.
struct AskOptions {
  BemOptions bem = {};
  int threads = 0;                   ///< 0: those of the calling thread
  const Control* control = nullptr;  ///< asked to stop: Interrupted, of a transient Answer::stopped
  std::function<void(const TransientState&)> observer = {};  ///< receives every state of a transient
  LifeOf life_of = {};                                       ///< none: lives are left out
};

struct Answer {
  BemResult result;  ///< patch and forces; rail_interior() and wheel_interior() give the stresses at any point. Of a
                     ///< transient those of its last state
  Summary summary;
  std::vector<TransientRow> history = {};        ///< a row a step; empty in steady rolling
  std::optional<LoadedMoment> moment = {};       ///< of a transient: what holds in its last state
  double coarsest = 0;                           ///< cell_of_patch of a transient's worst state
  bool stopped = false;                          ///< a transient, before its end: there is its contact alone
  std::vector<PatchDamage> wear = {};            ///< of each patch, if it rolls
  std::vector<SectionShakedown> shakedown = {};  ///< of the judged bodies
  std::vector<SlidingMap> sliding = {};
  std::optional<CrackResult> crack = {};
};

/// The case as half-space theory can treat it. A static case (run.rolling = false) has frictionless contact, as the
/// finite elements' preload has.
CaseSpec half_space_case(CaseSpec spec);

/// Throws what can be refused before the first iteration: CaseError for the size of the cells, or for a film that
/// cannot carry a transient's forces; EnvironmentError if there is not enough memory.
void require_solvable(const CaseSpec& spec, const Placement& placement, const BemOptions& bem);

/// The contact of half_space_case(spec): steady rolling, or the case's transient. For judge(), which completes it.
/// Throws as require_solvable, solve_bem and solve_transient; Interrupted.
Answer solve_contact(const CaseSpec& spec, const Placement& placement, const AskOptions& how = {});

/// Solved and judged. summary.run.threads is the number of threads of the calling thread (core/parallel.hpp), commit
/// that of the program. Several threads may ask at a time. Throws as solve_contact and judge.
Answer ask(const CaseSpec& spec, const Placement& placement, const Wanted& wanted = {}, const AskOptions& how = {});

}  // namespace railstrata
