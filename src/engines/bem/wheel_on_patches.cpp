#include "bem/wheel_on_patches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "core/faults.hpp"
#include "core/root.hpp"
#include "model/drive_at_contact.hpp"

namespace railstrata {

namespace {

constexpr double kLeastApproach = 1e-9;         // m
constexpr double kClosure = 0.05;               // of BemOptions::balance
constexpr double kRough = 1e-3;                 // of the load, without friction: whether patches merge is seen
constexpr double kRoughPressure = 1e-5;         // tolerance of the gap there
constexpr double kSharpFriction = 0.01;         // of the same, of friction: forces are known better than they close
constexpr double kNoWidth = 1e-13;              // of a creepage
constexpr double kLaidFrom = 0.5, kLaidTo = 2;  // of the approach that a grid was laid for
constexpr int kMostRounds = 60;

}  // namespace

bool WheelOnPatches::Member::loaded() const { return approach > kLeastApproach; }

double WheelOnPatches::Member::vertical() const {
  return normal * std::cos(contact().angle) - solution.tangential.force_y * std::sin(contact().angle);
}

/// Change of the normal force with the approach, N/m: of the last two solutions, if they agree with Hertz's.
double WheelOnPatches::Member::stiffness() const {
  if (!loaded()) return 0;
  const double of_hertz = 1.5 * normal / approach, secant = (normal - normal_before) / (approach - approach_before);
  return secant > 0.5 * of_hertz && secant < 2 * of_hertz ? secant : of_hertz;
}

double WheelOnPatches::Member::largest_pressure(int column) const {
  const PatchGrid& g = patch.grid;
  double out = 0;
  for (int i = 0; i < g.nx; ++i) out = std::max(out, solution.normal.pressure[g.index(i, column)]);
  return out;
}

WheelOnPatches::WheelOnPatches(const CaseSpec& spec, const Placement& placement, const std::vector<PatchPlace>& places,
                               double descent, const BemOptions& options)
    : spec_(spec),
      placement_(placement),
      options_(options),
      pressed_(descent),
      weight_(spec.vehicle.load()),
      modulus_(modulus_of(spec)),
      across_{yaw_creepage(placement.contact), 0} {
  options_.rolling.tangential.tolerance =
      std::min(options_.rolling.tangential.tolerance, kSharpFriction * options_.balance);
  options_.rolling.tangential.share_of_first = options_.rolling.normal.share_of_first = 1;  // starts are its own
  options_.cache = options.cache ? options.cache : &cache_;
  for (const PatchPlace& place : places) {
    Member m{.place = place, .placement = placement};
    m.placement.contact = m.place.first();
    m.estimate = hertz_estimate(spec, m.contact());
    m.below = placement.contact.axle_height - m.contact().axle_height;
    members_.push_back(std::move(m));
  }
}

std::vector<BemStart> WheelOnPatches::settle(std::size_t trial, double most) {
  const BemNeighbour none, &near = options_.neighbour ? *options_.neighbour : none;
  const bool begun = trial < near.smooth.size() && start_from(near.smooth[trial]);
  if (begun && surely_one()) return near.smooth[trial];
  if (!begun) descent_ = first_descent();
  descend();
  if (!options_.keep_cells && !cells_suit()) descend();
  std::vector<BemStart> smooth = starts();
  if (const auto meet = meeting(); meet && meet->reach > most) return smooth;
  if (start_from(near.patches)) descend();  // under friction's forces as they were
  rubs_ = true;
  descend();
  return smooth;
}

/// Takes the neighbour's descent and creepages, and pressures and tractions of patches of which one lies on the stretch
/// of each member at most, more than one together.
bool WheelOnPatches::start_from(const std::vector<BemStart>& patches) {
  if (patches.size() < 2) return false;
  std::vector<const BemStart*> of(members_.size(), nullptr);
  for (const BemStart& start : patches)
    for (std::size_t k = 0; k < members_.size(); ++k) {
      if (start.rail_s < members_[k].place.stretch.low || start.rail_s > members_[k].place.stretch.high) continue;
      if (of[k]) return false;
      of[k] = &start;
    }
  const BemNeighbour& near = *options_.neighbour;
  descent_ = spec_.vehicle.approach ? pressed_ : near.descent;
  stand();
  along_ = near.along;
  across_ = near.across;
  take_given_creepages();
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (of[k]) lay_start(members_[k], *of[k]);
  return true;
}

/// Whether the patches of the start, whose approaches are nearly those of this descent, meet by far more than patches
/// that are one: a solution would show the same.
bool WheelOnPatches::surely_one() const {
  constexpr double kNearly = 0.05;  // of load and approach
  constexpr double kByFar = 3;      // reach: pressures of the start are known to a few such shares
  if (!spec_.vehicle.approach && !(std::abs(vertical() - weight_) <= kNearly * weight_)) return false;
  for (const Member& m : members_)
    if (m.loaded() && m.solution.normal.pressure.empty()) return false;
  if (!near_in(kNearly)) return false;
  const auto meet = meeting();
  return meet && meet->reach > kByFar;
}

void WheelOnPatches::lay_start(Member& m, const BemStart& start) {
  m.approach = m.approach_before = m.laid_for = start.solution.normal.approach;
  m.normal = m.normal_before = m.expected = start.solution.normal.load;
  BemOptions cells = cells_for(m, m.approach);
  if (options_.keep_cells) {
    const BemOptions finer = cells_for(m, kLaidFrom * m.approach), coarser = cells_for(m, kLaidTo * m.approach);
    cells.cell = std::clamp(start.grid.dx, finer.cell, coarser.cell);
    cells.across = std::clamp(start.grid.dy, finer.across, coarser.across);
  }
  const PatchGrid wanted = first_grid(spec_, m.placement, cells, {.approach = m.approach}, m.room);
  if (!suits(start, wanted) || !holds(start.grid, m.room)) {
    m.laid_for = 0;
    return;
  }
  m.patch = {};  // laid in another grid, if at all
  m.patch.grid = start.grid;
  m.solution = start.solution;
}

std::optional<PatchesMeet> WheelOnPatches::meeting() const {
  constexpr double kNear = 1.1, kOne = 0.1;  // cells from the ridge; of the largest pressure
  std::optional<PatchesMeet> out;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Member& m = members_[k];
    if (!m.loaded()) continue;
    const PatchGrid& g = m.patch.grid;
    const double most = *std::max_element(m.solution.normal.pressure.begin(), m.solution.normal.pressure.end());
    for (int j = 0; j < g.ny; ++j) {
      const auto meets = [&](const std::optional<std::size_t>& beside, double from_ridge) {
        const double near = (kNear - from_ridge / g.dy) / (kNear - 1),
                     pressure = beside && near > 0 ? m.largest_pressure(j) : 0;
        if (!(pressure > 0)) return;
        const double reach = std::min(near, 1.0) * pressure / (kOne * most);
        if (!out || reach > out->reach) out = {std::min(k, *beside), std::max(k, *beside), reach};
      };
      meets(m.place.beside_low, g.y(j) - m.room.low);
      meets(m.place.beside_high, m.room.high - g.y(j));
    }
  }
  return out;
}

std::vector<BemStart> WheelOnPatches::starts() const {
  std::vector<BemStart> out;
  for (const Member& m : members_)
    if (m.loaded()) out.push_back({m.patch.grid, m.solution, m.contact().rail_s});
  return out;
}

SharedLoad WheelOnPatches::take() {
  SharedLoad out;
  out.load_iterations = iterations_;
  for (Member& m : members_)
    if (m.loaded())
      out.patches.push_back(
          {m.contact(), std::move(m.patch), std::move(m.solution), m.place.contacts, m.place.stretch});
  out.descent = descent_;
  out.along = along_;
  out.across = across_;
  return out;
}

void WheelOnPatches::descend() {
  constexpr int kSoon = 15;  // rounds; later ones take means: a small patch goes to and fro in the slope beside another
  const bool pressed = spec_.vehicle.approach.has_value();
  Eigen::MatrixXd bent = depressions();
  for (iterations_ = 1; iterations_ <= kMostRounds; ++iterations_) {
    bent = iterations_ > kSoon ? Eigen::MatrixXd(0.5 * (bent + depressions())) : depressions();
    const double moved = solve_at(bent), load = pressed ? vertical() : weight_,
                 close = (rubs_ ? options_.balance : kRough) * load, closed = rubs_ ? kClosure * close : close;
    if (moved <= close && (pressed || std::abs(vertical() - weight_) <= closed) && approaches_settled()) return;
    descent_ += step(bent);
  }
  if (pressed) throw NumericalError("no forces were found for a wheel with several contacts and a given approach");
  throw CaseError(
      "no vertical position of the wheel balances the weight on its contacts: the wheel is wedged by friction",
      "lower drive.friction_coefficient, or check lateral_shift and the profiles", "drive.friction_coefficient");
}

double WheelOnPatches::vertical() const {
  double sum = 0;
  for (const Member& m : members_)
    if (m.loaded()) sum += m.vertical();
  return sum;
}

/// Approach [m] of every patch that a force of 1 N on every other one takes away: row by column.
Eigen::MatrixXd WheelOnPatches::depressions() const {
  const auto n = static_cast<Eigen::Index>(members_.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Member& m = members_[static_cast<std::size_t>(k)];
    const Vec3 centre = m.on_rail().centre();
    for (Eigen::Index j = 0; j < n; ++j) {
      const Member& other = members_[static_cast<std::size_t>(j)];
      if (j != k && other.normal > 0)
        out(k, j) = std::cos(m.contact().angle - other.contact().angle) * other.on_rail().at(centre, 1, modulus_) /
                    other.normal;
    }
  }
  return out;
}

/// What the approaches lack of those of the normal forces as they are, m.
Eigen::VectorXd WheelOnPatches::lacking_approaches(const Eigen::MatrixXd& bent) const {
  const auto n = static_cast<Eigen::Index>(members_.size());
  Eigen::VectorXd normal(n), out(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Member& m = members_[static_cast<std::size_t>(k)];
    normal(k) = m.normal;
    out(k) = (descent_ - m.below) * std::cos(m.contact().angle) - m.approach;
  }
  return out - bent * normal;
}

/// Whether the approaches are within a share of those of the normal forces as they are.
bool WheelOnPatches::near_in(double share) const {
  const Eigen::VectorXd lacking = lacking_approaches(depressions());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const double lacks = lacking(static_cast<Eigen::Index>(k)), has = members_[k].approach;
    if (members_[k].loaded() ? !(std::abs(lacks) <= share * has) : has + lacks > kLeastApproach) return false;
  }
  return true;
}

/// Whether they are known well enough to see how far patches meet, and by friction what share of the answer this is.
bool WheelOnPatches::approaches_settled() const {
  constexpr double kRoughly = 0.01, kOnTheWay = 1e-5;
  return rubs_ ? !meeting() || near_in(kOnTheWay) : near_in(kRoughly);
}

/// Newton's step of the descent. With the stiffnesses S and the depressions C by a unit force the normal forces move by
/// dN = S (cos(delta) dd + r - C dN), r what the approach lacks of that of the forces N now. The forces expected after
/// the step go into the next approaches.
double WheelOnPatches::step(const Eigen::MatrixXd& bent) {
  const auto n = static_cast<Eigen::Index>(members_.size());
  Eigen::VectorXd cosine(n), share(n), stiff(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Member& m = members_[static_cast<std::size_t>(k)];
    cosine(k) = std::cos(m.contact().angle);
    share(k) = m.loaded() ? m.vertical() / m.normal : 0.0;
    stiff(k) = m.stiffness();
  }
  const Eigen::VectorXd lacking = lacking_approaches(bent);
  const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n) + stiff.asDiagonal() * bent;
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(system);
  const Eigen::VectorXd as_is = solver.solve(stiff.cwiseProduct(lacking)),
                        by_descent = solver.solve(stiff.cwiseProduct(cosine));
  const double rise = std::max(share.dot(by_descent), 0.1 * cosine.dot(by_descent)),
               wanted = (weight_ - vertical() - share.dot(as_is)) / rise,
               step = spec_.vehicle.approach ? 0.0 : std::clamp(wanted, -0.5 * descent_, descent_);
  for (Eigen::Index k = 0; k < n; ++k) {
    Member& m = members_[static_cast<std::size_t>(k)];
    m.expected = std::max(0.0, m.normal + as_is(k) + step * by_descent(k));
  }
  return step;
}

/// Lays Hertz's contacts without friction at a descent, the sum of their vertical forces, N.
double WheelOnPatches::lay(double descent) {
  double sum = 0;
  for (Member& m : members_) {
    m.approach = (descent - m.below) * std::cos(m.contact().angle);
    m.normal = m.loaded() ? weight_ * std::pow(m.approach / m.estimate.approach, 1.5) : 0.0;
    m.expected = m.normal;
    sum += m.normal * std::cos(m.contact().angle);
  }
  return sum;
}

/// That of a given approach, else where Hertz's contacts without friction bear the weight; lays them there.
double WheelOnPatches::first_descent() {
  if (spec_.vehicle.approach) {
    lay(pressed_);
    return pressed_;
  }
  double low = 0, high = members_.front().estimate.approach;
  while (lay(high) < weight_) high *= 2;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (lay(middle) < weight_ ? low : high) = middle;
  }
  lay(high);
  return high;
}

/// Planes, reference and the creepages that are given, at the descent.
void WheelOnPatches::stand() {
  if (stood_ == descent_) return;
  stood_ = descent_;
  reference_ = reference_of(placement_, descent_);
  take_given_creepages();
  for (Member& m : members_) {
    const RigidContact plane = plane_of(placement_, m.place, descent_);
    m.turned = m.turned || !same_place(plane, m.contact());
    m.placement.contact = plane;
    m.room = room_of(placement_, m.place, plane, descent_);
  }
}

/// Those that are not sought.
void WheelOnPatches::take_given_creepages() {
  const DriveSpec drive = drive_at_contact(spec_, reference_);
  if (!drive.traction()) along_.creepage = drive.creepage.value_or(0);
  if (!drive.lateral_traction_coefficient) across_.creepage = drive.lateral_creepage.value_or(yaw_creepage(reference_));
}

/// Solves all patches at the descent, with the depressions of the normal forces that are expected. Returns by how much
/// one of these was missed at most, N.
double WheelOnPatches::solve_at(const Eigen::MatrixXd& bent) {
  stand();
  for (std::size_t k = 0; k < members_.size(); ++k) {
    Member& m = members_[k];
    m.approach_before = m.approach;
    m.normal_before = m.normal;
    m.approach = (descent_ - m.below) * std::cos(m.contact().angle);
    for (std::size_t j = 0; j < members_.size(); ++j)
      m.approach -= bent(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * members_[j].expected;
    if (m.loaded()) lay_grid(m);
  }
  balance_traction();
  double moved = 0;
  for (Member& m : members_) {
    m.normal = m.loaded() ? m.solution.normal.load : 0.0;
    moved = std::max(moved, std::abs(m.normal - m.expected));
  }
  return moved;
}

double WheelOnPatches::cell_for(double semi_axis) const {
  double out = options_.cell;
  while (out > std::numbers::sqrt2 * std::max(0.15 * semi_axis, kSmallestCell)) out *= 0.5;
  return out;
}

/// An axis of a patch shorter than ten cells gets shorter ones: halves of halves, for which the influence of the last
/// patch serves.
BemOptions WheelOnPatches::cells_for(const Member& m, double approach) const {
  const double scale = std::sqrt(approach / m.estimate.approach);
  BemOptions out = options_;
  out.cell = cell_for(scale * m.estimate.a);
  out.across = cell_for(scale * m.estimate.b);
  return out;
}

/// Whether the cells are those for the approaches that were found; grids of others are to be laid anew.
bool WheelOnPatches::cells_suit() {
  bool out = true;
  for (Member& m : members_) {
    if (!m.loaded()) continue;
    const BemOptions wanted = cells_for(m, m.approach);
    if (m.patch.grid.dx == wanted.cell && m.patch.grid.dy == wanted.across) continue;
    m.laid_for = 0;
    out = false;
  }
  return out;
}

void WheelOnPatches::lay_grid(Member& m) {
  const NormalTarget target{.approach = m.approach};
  if (m.approach < kLaidTo * m.laid_for && m.approach > kLaidFrom * m.laid_for && holds(m.patch.grid, m.room)) {
    if (m.turned || !m.patch.influence)
      m.patch = case_patch_on(m.patch.grid, spec_, m.placement, options_, target, m.room);
  } else {
    m.patch = make_case_patch(spec_, m.placement, cells_for(m, m.approach), target, m.room);
    m.laid_for = m.approach;
    m.solution = {};
  }
  m.turned = false;
}

void WheelOnPatches::solve(Member& m) const {
  RollingContact& problem = m.patch.contact;
  problem.target.approach = m.approach;
  problem.x = {along_.creepage, {}};
  problem.y = {across_.creepage, {}};
  carry_creepages(turn_about_vertical(spec_, reference_), reference_, m.contact(), problem);
  if (rubs_) {
    const RollingSolution* start = m.solution.normal.pressure.empty() ? nullptr : &m.solution;
    m.solution = solve_rolling(*m.patch.influence, m.patch.grid, problem, options_.rolling, start);
    return;
  }
  NormalOptions rough = options_.rolling.normal;
  rough.tolerance = std::max(rough.tolerance, kRoughPressure);
  NormalSolution& normal = m.solution.normal;
  normal = solve_normal(*m.patch.influence, m.patch.grid, problem.gap, problem.target, rough, normal.pressure);
}

/// Solves all patches under the creepages as they stand.
void WheelOnPatches::solve_all() {
  for (Member& m : members_) {
    if (!m.loaded()) continue;
    solve(m);
    if (!m.solution.normal.touches_edge) continue;
    m.laid_for = 0;
    lay_grid(m);
    solve(m);
  }
}

/// Sum of one force of the friction on the rail over the patches, N.
double WheelOnPatches::sum(double TangentialSolution::*force) const {
  double out = 0;
  for (const Member& m : members_)
    if (m.loaded()) out += m.solution.tangential.*force;
  return out;
}

/// Finds the creepages under which the forces have the wanted sums, where they are wanted: the longitudinal one for
/// every lateral one that is tried.
void WheelOnPatches::balance_traction() {
  const DriveSpec& drive = spec_.drive;
  const bool friction = rubs_ && drive.friction_coefficient > 0;
  const auto along = [&] {
    solve_all();
    return sum(&TangentialSolution::force_x) + drive.traction().value_or(0) * weight_;
  };
  const auto across = [&] {
    if (drive.traction())
      find(along_, along);
    else
      solve_all();
    return sum(&TangentialSolution::force_y) + *drive.lateral_traction_coefficient * weight_;
  };
  if (friction && drive.lateral_traction_coefficient)
    find(across_, across);
  else if (friction && drive.traction())
    find(along_, along);
  else
    solve_all();
}

/// Brings an excess of force, which rises with the creepage, to zero; it hardly rises where all patches slide.
template <class Excess>
void WheelOnPatches::find(SoughtCreepage& sought, Excess&& excess_now) const {
  const auto excess_at = [&](double creepage) {
    sought.creepage = creepage;
    return excess_now();
  };
  double a = sought.creepage, at_a = excess_at(a);
  const double close = 0.5 * kClosure * options_.balance * weight_;
  if (std::abs(at_a) <= close) return;
  double step = sought.compliance > 0 ? 1.5 * std::abs(at_a) * sought.compliance : 1e-4, b = a, at_b = at_a;
  while (at_a * at_b > 0) {
    if (std::abs(b) > 1) refuse_traction();
    a = b;
    at_a = at_b;
    b = a + (at_a > 0 ? -step : step);
    at_b = excess_at(b);
    step *= 3;
  }
  sought.compliance = (b - a) / (at_b - at_a);
  if (!narrow_root(a, at_a, b, at_b, close, kNoWidth, 100, excess_at))
    throw NumericalError("no creepage was found for a wheel with several contacts");
}

void WheelOnPatches::refuse_traction() const {
  const DriveSpec& drive = spec_.drive;
  const double along = drive.traction().value_or(0), across = drive.lateral_traction_coefficient.value_or(0);
  double available = 0;
  for (const Member& m : members_)
    if (m.loaded()) available += drive.friction_coefficient * m.solution.normal.load;
  const char* key = across == 0 ? "drive.traction_coefficient" : "drive.lateral_traction_coefficient";
  throw CaseError(fmt::format("a traction coefficient of {:g}{} needs {:.0f} N of friction; the {} contacts of the "
                              "wheel, which roll on different radii and spin, provide less than {:.0f} N together",
                              along, across == 0 ? "" : fmt::format(" along and {:g} across the rail", across),
                              std::hypot(along, across) * weight_, members_.size(), available),
                  fmt::format("lower {} or raise drive.friction_coefficient", key), key);
}

}  // namespace railstrata
