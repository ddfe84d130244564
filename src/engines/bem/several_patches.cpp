#include "bem/several_patches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/LU>

#include "core/faults.hpp"
#include "core/root.hpp"
#include "model/drive_at_contact.hpp"

namespace railstrata {

namespace {

constexpr double kLeastApproach = 1e-9;  // m

double modulus_of(const CaseSpec& spec) {
  return contact_modulus({spec.wheel_material.young, spec.wheel_material.poisson},
                         {spec.rail_material.young, spec.rail_material.poisson});
}

/// The pressure of a patch, in space; of one that has not been solved yet a force at the rigid contact point.
struct PressureOnRail {
  const RigidContact& contact;
  const PatchGrid& grid;
  const Plane& pressure;
  double force;

  Vec3 point(double x, double t) const {
    return {contact.x + x, contact.point.y + t * std::cos(contact.angle),
            contact.point.z + t * std::sin(contact.angle)};
  }
  /// Calls share(force, place) for every cell that bears.
  template <class Share>
  void for_each_share(Share&& share) const {
    if (pressure.empty()) return share(force, point(0, 0));
    for (std::size_t k = 0; k < pressure.size(); ++k)
      if (pressure[k] > 0) share(pressure[k] * grid.cell_area(), point(grid.x_of(k), grid.y_of(k)));
  }
  Vec3 centre() const {
    Vec3 sum;
    double total = 0;
    for_each_share([&](double f, Vec3 place) {
      sum += f * place;
      total += f;
    });
    return total > 0 ? (1 / total) * sum : point(0, 0);
  }
  /// The sum of force/distance^power at a place, over pi E*.
  double at(Vec3 place, int power, double modulus) const {
    double sum = 0;
    for_each_share([&](double f, Vec3 from) {
      const Vec3 d = place - from;
      sum += f / std::pow(std::hypot(d.x, d.y, d.z), power);
    });
    return sum / (std::numbers::pi * modulus);
  }
};

/// One patch of the wheel while the load is being shared.
struct Member {
  PatchPlace place;
  Placement placement;  ///< its contact is the plane under the descent
  PatchRoom room{};
  bool turned = false;                            ///< the plane is another one than that of the grid
  HertzContact estimate{};                        ///< under the weight
  double below = 0;                               ///< h, m
  double approach = 0, laid_for = 0;              ///< m; the approach for which the grid was laid
  double normal = 0;                              ///< N, of the last solution; to begin with an estimate
  double expected = 0;                            ///< N, of the next
  double approach_before = 0, normal_before = 0;  ///< of the solution before
  CasePatch patch{};
  RollingSolution solution{};

  const RigidContact& contact() const { return placement.contact; }
  bool loaded() const { return approach > kLeastApproach; }
  PressureOnRail on_rail() const { return {contact(), patch.grid, solution.normal.pressure, normal}; }
  double vertical() const {
    return normal * std::cos(contact().angle) - solution.tangential.force_y * std::sin(contact().angle);
  }
};

std::vector<Member> members_of(const CaseSpec& spec, const Placement& placement, std::vector<PatchPlace> places) {
  std::vector<Member> out;
  for (PatchPlace& place : places) {
    Member m{.place = std::move(place), .placement = placement};
    m.placement.contact = m.place.first();
    m.estimate = hertz_estimate(spec, m.contact());
    m.below = placement.contact.axle_height - m.contact().axle_height;
    out.push_back(std::move(m));
  }
  return out;
}

/// The wheel on its patches: descent and creepage are sought.
class WheelOnPatches {
 public:
  WheelOnPatches(const CaseSpec& spec, const Placement& placement, std::vector<Member> members,
                 const BemOptions& options)
      : spec_(spec),
        placement_(placement),
        members_(std::move(members)),
        options_(options),
        weight_(spec.vehicle.load()),
        modulus_(modulus_of(spec)),
        along_{},
        across_{yaw_creepage(placement.contact), 0} {
    options_.rolling.tangential.tolerance = std::min(options_.rolling.tangential.tolerance, kSharp * options_.balance);
    options_.rolling.tangential.share_of_first = options_.rolling.normal.share_of_first = 1;  // starts are its own
    options_.cache = options.cache ? options.cache : &cache_;
  }

  /// Without friction first, which shows at little cost which patches merge; where none do, with friction from there.
  void settle() {
    descent_ = first_descent();
    rubs_ = false;
    descend();
    if (merged()) return;
    rubs_ = true;
    descend();
  }

  /// Two patches of which one reaches the ridge between them.
  std::optional<std::pair<std::size_t, std::size_t>> merged() const {
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const Member& m = members_[k];
      if (!m.loaded()) continue;
      const PatchGrid& g = m.patch.grid;
      for (int j = 0; j < g.ny; ++j) {
        if (!carries(m, j)) continue;
        if (m.place.beside_low && g.y(j) - g.dy < m.room.low) return {{k, *m.place.beside_low}};
        if (m.place.beside_high && g.y(j) + g.dy > m.room.high) return {{k, *m.place.beside_high}};
      }
    }
    return {};
  }

  SharedLoad take() {
    SharedLoad out;
    out.load_iterations = iterations_;
    for (Member& m : members_)
      if (m.loaded()) out.patches.push_back({m.contact(), std::move(m.patch), std::move(m.solution), m.place.contacts});
    out.descent = descent_;
    return out;
  }

 private:
  static constexpr double kClosure = 0.05;   // of BemOptions::balance
  static constexpr double kSharp = 0.01;     // of the same, of friction: forces are known better than they close
  static constexpr double kNoWidth = 1e-13;  // of a creepage
  static constexpr int kMostIterations = 60;

  void descend() {
    const bool pressed = spec_.vehicle.approach.has_value();
    for (iterations_ = 1; iterations_ <= kMostIterations; ++iterations_) {
      const Eigen::MatrixXd bent = depressions();
      const double moved = solve_at(descent_, bent), close = options_.balance * (pressed ? vertical() : weight_);
      if (moved <= close && (pressed || std::abs(vertical() - weight_) <= kClosure * close)) return;
      descent_ += step(descent_, bent);
    }
    if (pressed) throw NumericalError("no forces were found for a wheel with several contacts and a given approach");
    throw CaseError(
        "no vertical position of the wheel balances the weight on its contacts: the wheel is wedged by friction",
        "lower drive.friction_coefficient, or check lateral_shift and the profiles", "drive.friction_coefficient");
  }

  static bool carries(const Member& m, int column) {
    const PatchGrid& g = m.patch.grid;
    for (int i = 0; i < g.nx; ++i)
      if (m.solution.normal.pressure[g.index(i, column)] > 0) return true;
    return false;
  }

  double vertical() const {
    double sum = 0;
    for (const Member& m : members_)
      if (m.loaded()) sum += m.vertical();
    return sum;
  }

  /// Change of a patch's normal force with its approach, N/m: of the last two solutions, if they agree with Hertz's.
  static double stiffness(const Member& m) {
    if (!m.loaded()) return 0;
    const double of_hertz = 1.5 * m.normal / m.approach,
                 secant = (m.normal - m.normal_before) / (m.approach - m.approach_before);
    return secant > 0.5 * of_hertz && secant < 2 * of_hertz ? secant : of_hertz;
  }

  /// Approach [m] of every patch that a force of 1 N on every other one takes away: row by column.
  Eigen::MatrixXd depressions() const {
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

  /// Newton's step of the descent. With the stiffnesses S and the depressions C by a unit force the normal forces move
  /// by dN = S (cos(delta) dd + r - C dN), r what the approach lacks of that of the forces N now. The forces expected
  /// after the step go into the next approaches.
  double step(double descent, const Eigen::MatrixXd& bent) {
    const auto n = static_cast<Eigen::Index>(members_.size());
    Eigen::VectorXd normal(n), lacking(n), cosine(n), share(n), stiff(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Member& m = members_[static_cast<std::size_t>(k)];
      normal(k) = m.normal;
      cosine(k) = std::cos(m.contact().angle);
      lacking(k) = (descent - m.below) * cosine(k) - m.approach;
      share(k) = m.loaded() ? m.vertical() / m.normal : 0.0;
      stiff(k) = stiffness(m);
    }
    lacking -= bent * normal;
    const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n) + stiff.asDiagonal() * bent;
    const Eigen::PartialPivLU<Eigen::MatrixXd> solver(system);
    const Eigen::VectorXd as_is = solver.solve(stiff.cwiseProduct(lacking)),
                          by_descent = solver.solve(stiff.cwiseProduct(cosine));
    const double rise = std::max(share.dot(by_descent), 0.1 * cosine.dot(by_descent)),
                 wanted = (weight_ - vertical() - share.dot(as_is)) / rise,
                 step = spec_.vehicle.approach ? 0.0 : std::clamp(wanted, -0.5 * descent, descent);
    for (Eigen::Index k = 0; k < n; ++k)
      members_[static_cast<std::size_t>(k)].expected = std::max(0.0, normal(k) + as_is(k) + step * by_descent(k));
    return step;
  }

  /// Lays Hertz's contacts without friction at a descent, the sum of their vertical forces, N.
  double lay(double descent) {
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
  double first_descent() {
    if (spec_.vehicle.approach) {
      const double descent = descent_of(placement_, *spec_.vehicle.approach);
      lay(descent);
      return descent;
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

  /// Planes, reference and the creepages that are given, at a descent.
  void stand(double descent) {
    reference_ = reference_of(placement_, descent);
    const DriveSpec drive = drive_at_contact(spec_, reference_);
    if (!drive.traction()) along_.creepage = drive.creepage.value_or(0);
    if (!drive.lateral_traction_coefficient)
      across_.creepage = drive.lateral_creepage.value_or(yaw_creepage(reference_));
    for (Member& m : members_) {
      const RigidContact plane = plane_of(placement_, m.place, descent);
      m.turned = !same_place(plane, m.contact());
      m.placement.contact = plane;
      m.room = room_of(placement_, m.place, plane);
    }
  }

  /// Solves all patches at a descent, with the depressions of the normal forces that are expected. Returns by how much
  /// one of these was missed at most, N.
  double solve_at(double descent, const Eigen::MatrixXd& bent) {
    stand(descent);
    for (std::size_t k = 0; k < members_.size(); ++k) {
      Member& m = members_[k];
      m.approach_before = m.approach;
      m.normal_before = m.normal;
      m.approach = (descent - m.below) * std::cos(m.contact().angle);
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

  /// An axis of a patch shorter than ten cells gets shorter ones: halves of halves, for which the influence of the last
  /// patch serves.
  void lay_grid(Member& m) {
    BemOptions own = options_;
    if (m.approach < 2 * m.laid_for && m.approach > 0.5 * m.laid_for) {
      if (m.turned) m.patch = case_patch_on(m.patch.grid, spec_, m.placement, own, {.approach = m.approach}, m.room);
      return;
    }
    const double scale = std::sqrt(m.approach / m.estimate.approach);
    own.cell = cell_for(scale * m.estimate.a);
    own.across = cell_for(scale * m.estimate.b);
    m.patch = make_case_patch(spec_, m.placement, own, {.approach = m.approach}, m.room);
    m.laid_for = m.approach;
    m.solution = {};
  }

  double cell_for(double semi_axis) const {
    double out = options_.cell;
    while (out > std::numbers::sqrt2 * std::max(0.15 * semi_axis, kSmallestCell)) out *= 0.5;
    return out;
  }

  void solve(Member& m) const {
    RollingContact& problem = m.patch.contact;
    problem.target.approach = m.approach;
    problem.x = {along_.creepage, {}};
    problem.y = {across_.creepage, {}};
    carry_creepages(turn_about_vertical(spec_, reference_), reference_, m.contact(), problem);
    const auto solve_as = [&](const RollingContact& contact) {
      const bool fresh = m.solution.normal.pressure.empty();
      m.solution =
          solve_rolling(*m.patch.influence, m.patch.grid, contact, options_.rolling, fresh ? nullptr : &m.solution);
    };
    if (rubs_) return solve_as(problem);
    RollingContact smooth = problem;
    smooth.friction = 0;
    smooth.local_friction.clear();
    solve_as(smooth);
  }

  /// Solves all patches under the creepages as they stand.
  void solve_all() {
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
  double sum(double TangentialSolution::*force) const {
    double out = 0;
    for (const Member& m : members_)
      if (m.loaded()) out += m.solution.tangential.*force;
    return out;
  }

  /// Finds the creepages under which the forces have the wanted sums, where they are wanted: the longitudinal one for
  /// every lateral one that is tried.
  void balance_traction() {
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

  /// A creepage that is sought, and its change with the force, 1/N, of the last search.
  struct Sought {
    double creepage = 0, compliance = 0;
  };

  /// Brings an excess of force, which rises with the creepage, to zero; it hardly rises where all patches slide.
  template <class Excess>
  void find(Sought& sought, Excess&& excess_now) const {
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

  [[noreturn]] void refuse_traction() const {
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

  const CaseSpec& spec_;
  const Placement& placement_;
  RigidContact reference_;
  std::vector<Member> members_;
  InfluenceCache cache_;
  BemOptions options_;
  double weight_, modulus_;
  Sought along_, across_;  // creepages of the reference
  double descent_ = 0;
  bool rubs_ = false;  // the patches have friction
  int iterations_ = 0;
};

}  // namespace

SharedLoad share_load(const CaseSpec& spec, const Placement& placement, double descent, const BemOptions& options) {
  std::vector<ContactPlace> places = places_of(spec, placement, descent);
  for (;;) {
    put_in_order(places);
    SharedLoad alone;
    alone.descent = descent;
    std::vector<PatchPlace> patches = patch_places(placement, places);
    alone.alone = patches.front();
    alone.places = places.size();
    if (patches.size() == 1) return alone;
    WheelOnPatches wheel(spec, placement, members_of(spec, placement, std::move(patches)), options);
    wheel.settle();
    const auto merged = wheel.merged();
    if (!merged) {
      SharedLoad out = wheel.take();
      if (out.patches.size() > 1 || out.patches.front().contacts.size() > 1) return out;
      const bool first = out.patches.front().contacts.front().rail_s == placement.contact.rail_s;
      return first ? alone : out;
    }
    const auto [into, from] = std::minmax(merged->first, merged->second);
    for (ContactPlace& p : places)
      if (p.patch == from) p.patch = into;
  }
}

double bending_by_others(const CaseSpec& spec, const std::vector<PatchOnWheel>& patches, const PatchOnWheel& one) {
  const auto pressure = [](const PatchOnWheel& p) {
    return PressureOnRail{p.contact, p.patch.grid, p.solution.normal.pressure, p.solution.normal.load};
  };
  const RigidContact& c = one.contact;
  const double own =
      std::min(c.curvature_rolling, std::max(c.curvature_wheel_lateral + c.curvature_rail_lateral, 0.02));
  double bent = 0;
  for (const PatchOnWheel& other : patches)
    if (&other != &one) bent += 2 * pressure(other).at(pressure(one).centre(), 3, modulus_of(spec));
  return bent / own;
}

}  // namespace railstrata
