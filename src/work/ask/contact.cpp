#include "ask/contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "ask/answer.hpp"
#include "ask/solve_settings.hpp"
#include "geometry/read_profile.hpp"
#include "judge/bem_summary.hpp"
#include "judge/plausibility.hpp"
#include "model/drive_at_contact.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

/// Calls `work`, whose inputs were looked at before: a CaseError is physics then.
template <class Work>
void by_physics(Work&& work) {
  try {
    work();
  } catch (const CaseError& e) {
    throw NoAnswer(e);
  }
}

CaseSpec case_of_contact(const LoadedCase& loaded) {
  require_support(uses::kStates, loaded);
  CaseSpec spec = half_space_case(loaded.spec);
  spec.drive.creepage_of = CreepageOf::contact;
  return spec;
}

bool is_lifted(const State& s) {
  if (s.approach && s.load) return false;
  return (s.approach && std::isfinite(*s.approach) && *s.approach <= 0) || (s.load && *s.load == 0);
}

bool stands_at(const GeometrySpec& geometry, const TrackGeometry& track) {
  return geometry.lateral_shift == track.lateral_shift && geometry.yaw == track.yaw && geometry.roll == track.roll;
}

/// Of the patch that stands farthest on or over its flange.
std::vector<Warning> climbed(const BemResult& result) {
  std::vector<Warning> out;
  for (const BemPatch* patch : patches_of(result))
    if (std::vector<Warning> of_patch = flange_warnings(patch->surroundings); of_patch.size() > out.size())
      out = std::move(of_patch);
  return out;
}

std::string remarks_of(const BemResult& result, const Summary& summary, const std::vector<std::string>& of_profiles) {
  std::string out;
  const auto fails = [&](const auto& check) {
    out += fmt::format("check {} fails: {:g}, limit {:g}\n", check.name, check.value, check.limit);
  };
  for (const Check& check : summary.checks)
    if (!check.ok) fails(check);
  for (const Warning& warning : climbed(result)) fails(warning);
  for (const std::vector<std::string>& notes : {of_profiles, result.notes})
    for (const std::string& note : notes) out += note + "\n";
  if (!out.empty()) out.pop_back();
  return out;
}

Slopes slopes_of(const ContactDerivative& d) {
  return {-d.force.x,   -d.force.y, -d.force.z, d.force.normal, -d.force.tangential, -d.force.moment, d.creepage_x,
          d.creepage_y, d.spin,     d.approach, d.angle};
}

/// The same as differences of two solutions.
Slopes slopes_between(const PlacedCase& more, const PlacedCase& less, double step, const BemOptions& options) {
  const auto forces = [&](const PlacedCase& there) {
    const BemResult result = solve_bem(there.spec, there.placement, options);
    return forces_of(result, bem_contact_summary(there.spec, result));
  };
  Forces above, below;
  by_physics([&] {
    above = forces(more);
    below = forces(less);
  });
  Slopes out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto number = std::get<double Forces::*>(kForces[k].at);
    out[k] = (above.*number - below.*number) / (2 * step);
  }
  return out;
}

}  // namespace

Forces forces_of(const BemResult& result, const Summary& summary) {
  const ContactSummary& c = summary.contact;
  Forces out{{},
             c.F_x,
             c.F_y,
             c.F_z,
             c.normal_force,
             c.lateral_force,
             c.spin_moment,
             c.creepage_x,
             c.creepage_y,
             c.spin_per_m,
             c.approach,
             c.contact_angle,
             c.patch.p_max,
             c.patch.q_max,
             c.patch.area,
             c.patch.slip_area_fraction * c.patch.area,
             dissipation(result),
             static_cast<int>(1 + result.further.size()),
             cells_with_pressure(result.field),
             result.effort.iterations};
  out.checks_hold = climbed(result).empty();
  for (const Check& check : summary.checks) out.checks_hold = out.checks_hold && check.ok;
  return out;
}

int cells_with_pressure(const ContactField& field) {
  return static_cast<int>(std::count_if(field.p.begin(), field.p.end(), [](double p) { return p > 0; }));
}

Contact::Contact(const LoadedCase& loaded)
    : spec_(case_of_contact(loaded)),
      placement_(railstrata::place(spec_, loaded.folder())),
      here_{spec_, placement_},
      more_(here_),
      less_(here_) {
  options_.cache = cache_.get();
}

void Contact::set_cell(double cell) {
  require_cell(cell);
  options_.cell = cell;
}

void Contact::set_tolerance(double t) {
  constexpr double kSharpest = 1e-12, kRoughest = 1e-3;
  if (!(t >= kSharpest && t <= kRoughest))
    throw CaseError(fmt::format("a tolerance of {:g} is out of range", t),
                    fmt::format("give a number from {:g} to {:g}", kSharpest, kRoughest));
  set_tolerance(options_, t);
}

void Contact::set_tolerance(BemOptions& options, double t) {
  options.rolling.tangential.tolerance = options.rolling.coupling_tolerance = options.balance = t;
  options.rolling.normal.tolerance = 0.01 * t;
}

const Placement& Contact::place(InState& out, const KnownPlace& known) const {
  const GeometrySpec& now = out.spec.geometry;
  if (stands_at(now, placement_.track)) return placement_;
  TrackGeometry& track = out.moved.track;
  if (out.placed && stands_at(now, track)) return out.moved;
  out.placed = false;
  track = placement_.track;
  track.lateral_shift = now.lateral_shift;
  track.yaw = now.yaw;
  track.roll = now.roll;
  by_physics([&] { out.moved.contact = place_wheel(out.moved.wheel, out.moved.rail, track, {}, known); });
  out.placed = true;
  return out.moved;
}

const Placement& Contact::set(const State& state, InState& out) const {
  set_state(state, spec_, out.spec);
  return place(out);
}

Forces Contact::lifted(State state) {
  Forces out;
  out.approach = state.approach.value_or(0);
  state.approach.reset();
  state.load.reset();
  const RigidContact& there = set(state, here_).contact;
  const DriveSpec& drive = here_.spec.drive;
  out.creepage_x = drive.creepage.value_or(0);
  out.creepage_y = drive.lateral_creepage.value_or(yaw_creepage(there));
  out.spin = spin_at(here_.spec, there);
  out.contact_angle = there.angle;
  return out;
}

void Contact::drop_solution() {
  last_.reset();
  state_.reset();
  remarks_.clear();
}

Forces Contact::solve(const State& state) {
  drop_solution();
  if (is_lifted(state)) {
    const Forces out = lifted(state);
    state_ = state;
    return out;
  }
  if (!state.extrapolate || !state.approach) return pressed(state);
  try {
    return pressed(state);
  } catch (const NoAnswer& refused) {
    return continued(state, refused);
  }
}

Forces Contact::continued(State state, const NoAnswer& refused) {
  constexpr double kSmallest = 10e-6, kStep = 1.1;  // m
  constexpr std::size_t kLinear = 9;                // of kForces: forces, moment, creepages
  const NextStart before = start;
  const double wanted = *state.approach;
  const auto approach_of = [&](int k) { return kSmallest * std::pow(kStep, k); };
  const auto borne = [&](int k) -> std::optional<Forces> {
    state.approach = approach_of(k);
    state.descent = 0;
    start = before;
    try {
      return pressed(state);
    } catch (const NoAnswer&) {
    } catch (const NumericalError&) {
    }
    return {};
  };
  int most = 1, refusing = std::max(2, static_cast<int>(std::ceil(std::log(wanted / kSmallest) / std::log(kStep))));
  while (refusing - most > 1) {
    const int middle = (most + refusing) / 2;
    (borne(middle) ? most : refusing) = middle;
  }
  const std::optional<Forces> less = borne(most - 1), last = borne(most);
  start = before;
  if (!less || !last || approach_of(most) > wanted) {
    drop_solution();
    throw refused;
  }
  Forces out = *last;
  const double share = (wanted - approach_of(most)) / (approach_of(most) - approach_of(most - 1));
  for (std::size_t k = 0; k < kLinear; ++k) {
    const auto number = std::get<double Forces::*>(kForces[k].at);
    out.*number += share * (out.*number - *less.*number);
  }
  out.approach = wanted;
  out.beyond = true;
  out.checks_hold = false;
  remarks_ = fmt::format(
      "check half_spaces fails: an approach of {:.4g} mm is beyond what half-spaces bear; forces are "
      "continued from {:.4g} mm along a line{}{}",
      wanted / kMilli, approach_of(most) / kMilli, remarks_.empty() ? "" : "\n", remarks_);
  return out;
}

Forces Contact::pressed(const State& state) {
  const Placement& here = set(state, here_);
  BemOptions options = options_;
  BemNeighbour neighbour = start.of(here_.spec);
  options.neighbour = &neighbour;
  options.descent = state.descent;
  options.keep_cells = state.keep_cells;
  constexpr double kFollowed = 1e-2;  // of a start's violation: the smallest change of a state counts
  if (!neighbour.empty()) options.rolling.normal.share_of_first = options.rolling.tangential.share_of_first = kFollowed;
  by_physics([&] { last_ = solve_bem(here_.spec, here, options); });
  start.add(here_.spec, std::move(neighbour));
  const Summary summary = bem_contact_summary(here_.spec, *last_);
  state_ = state;
  remarks_ = remarks_of(*last_, summary, placement_.notes);
  return forces_of(*last_, summary);
}

std::unique_ptr<ContactEquations> Contact::equations() {
  if (!last_) return nullptr;
  const PlacedCase here = case_in(*state_);
  auto out = std::make_unique<ContactEquations>();
  out->options = options_;
  if (const BemStart* solved = start.last().alone(); solved && start.last().others.empty())
    out->of.emplace(here.spec, here.placement, out->options, *solved, start.last().descent, start.last().whole);
  if (out->of && !out->of->linear()) out->of.reset();
  return out;
}

std::vector<Slopes> Contact::slopes(const std::vector<const StateMember*>& inputs) {
  constexpr double kTolerance = 1e-10, kLonger = 30;  // of differences: a step that their errors allow
  std::vector<Slopes> out(inputs.size(), Slopes{});
  if (state_ && !last_) return out;  // lifted
  patch(0);
  const auto last = equations();
  const Placement& here = case_in(*state_).placement;
  const bool linear = last->of.has_value();
  const KnownPlace known = linear ? KnownPlace{&here.contact, start.last().descent} : KnownPlace{};
  if (!linear) set_tolerance(last->options, kTolerance);
  const auto beside = [&](const StateMember& input, double value, InState& there) -> PlacedCase {
    State state = *state_;
    state.*input.at = value;
    set_state(state, spec_, there.spec);
    return {there.spec, stands_at(there.spec.geometry, here.track) ? here : place(there, known)};
  };
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const StateMember& input = *inputs[k];
    const double value = value_in_state(input, *state_, here_.spec, *last_),
                 step = (linear ? 1 : kLonger) * step_of(input, here_.spec);
    const PlacedCase more = beside(input, value + step, more_), less = beside(input, value - step, less_);
    out[k] = linear ? slopes_of(last->of->by(more, less, step)) : slopes_between(more, less, step, last->options);
  }
  return out;
}

const BemPatch& Contact::patch(int index) const {
  if (!last_)
    throw CaseError("there is no solution", state_ ? "the wheel of the last state is lifted" : "solve a state first");
  const auto patches = patches_of(*last_);
  if (index < 0 || index >= static_cast<int>(patches.size()))
    throw CaseError(fmt::format("there is no patch {}", index), fmt::format("give 0 to {}", patches.size() - 1));
  return *patches[static_cast<std::size_t>(index)];
}

std::vector<Sym3> Contact::stress(BodyId body, const std::vector<Vec3>& points) const {
  patch(0);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const Vec3& p = points[k]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || p.z < 0)
      throw CaseError(fmt::format("point {} is ({:g}, {:g}, {:g})", k, p.x, p.y, p.z),
                      "give finite numbers, and a depth of 0 or more");
  const Subsurface inside = body == BodyId::rail ? rail_interior(*last_) : wheel_interior(*last_);
  std::vector<Sym3> out;
  try {
    for (const InteriorPoint& point : inside.at(points)) out.push_back(point.stress);
  } catch (const std::out_of_range& e) {
    throw CaseError(e.what(), "give points near the contact, in metres");
  }
  return out;
}

void Contact::set_profile(BodyId body, std::vector<Vec2> points) {
  const bool wheel = body == BodyId::wheel;
  Placement changed = placement_;
  const GeometrySpec& geometry = spec_.geometry;
  const std::filesystem::path file(wheel ? geometry.wheel_profile : geometry.rail_profile);
  for (const std::string& source : {file.filename().string(), std::string(body_word(body))})
    std::erase_if(changed.notes, [&](const std::string& note) { return note.starts_with(source + ": "); });
  (wheel ? changed.wheel : changed.rail) = profile_of_points(wheel ? ProfileKind::wheel : ProfileKind::rail,
                                                             std::move(points), body_word(body), &changed.notes);
  changed.contact = place_wheel(changed.wheel, changed.rail, changed.track);
  placement_ = std::move(changed);
  for (InState* state : {&here_, &more_, &less_}) {
    state->moved = placement_;
    state->placed = false;
  }
  drop_solution();
}

void Contact::move_to(const TrackGeometry& track, const HeldPlace& held, const KnownPlace& known) {
  by_physics([&] { placement_.contact = place_wheel(placement_.wheel, placement_.rail, track, held, known); });
  placement_.track = track;
  spec_.geometry.lateral_shift = track.lateral_shift;
  spec_.geometry.yaw = track.yaw;
  spec_.geometry.roll = track.roll;
}

}  // namespace railstrata
