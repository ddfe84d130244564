#include "single_track/single_track.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "damage/enclosing_ball.hpp"
#include "single_track/cone_program.hpp"
#include "single_track/spline_basis.hpp"

namespace railstrata {
namespace {

/// Lengths in half-lengths of the patch, y and x from its centre.
struct Row {
  double depth = 0;
  double metres = 0;  ///< depth in m; of an interface as it was given, to the bit
  bool below = false;
  double strength = 0;  ///< Pa
};

/// Breaks of [from, to]: `cell` apart to `dense`, then growing by a factor 1.3; equally many cells fit exactly.
void add_breaks(double from, double to, double dense, double cell, std::vector<double>& breaks) {
  constexpr double growth = 0.26;  // ln 1.3
  const double inside = dense / cell;
  const auto count = [&](double t) {
    return t < dense ? t / cell : inside + std::log1p(growth * (t - dense) / cell) / growth;
  };
  const auto place = [&](double n) {
    return n < inside ? n * cell : dense + cell * std::expm1(growth * (n - inside)) / growth;
  };
  const double begin = count(from), length = count(to) - begin;
  const int n = std::max(1, static_cast<int>(std::ceil(length - 1e-6)));
  for (int i = 1; i < n; ++i) breaks.push_back(place(begin + length * i / n));
  breaks.push_back(to);
}

/// Each interval in `parts`.
std::vector<double> divided(const std::vector<double>& breaks, int parts) {
  std::vector<double> all = {breaks.front()};
  for (std::size_t b = 1; b < breaks.size(); ++b)
    for (int i = 1; i <= parts; ++i)
      all.push_back(i == parts ? breaks[b] : breaks[b - 1] + (breaks[b] - breaks[b - 1]) * i / parts);
  return all;
}

void check(const SingleTrackInput& in, const SingleTrackOptions& options) {
  if (!(in.half_length > 0 && in.half_width > 0)) throw std::invalid_argument("single track: the patch has no extent");
  if (!in.stress || !in.shear_strength) throw std::invalid_argument("single track: stresses or strengths are missing");
  if (!(options.cell > 0 && options.box >= 2 && options.accuracy > 0))
    throw std::invalid_argument("single track: cell and accuracy are > 0, the box has at least 2 half-axes");
  for (std::size_t i = 0; i < in.interfaces.size(); ++i)
    if (!(in.interfaces[i] > (i == 0 ? 0 : in.interfaces[i - 1])))
      throw std::invalid_argument("single track: interfaces have ascending depths > 0");
}

class Track {
 public:
  Track(const SingleTrackInput& in, const SingleTrackOptions& options);
  SingleTrack solve();

 private:
  struct Point {
    double y = 0;
    Row row;
    std::vector<ShapeTerm> shapes;
    std::vector<Vec5> path;  ///< deviators over strength
    std::vector<char> used;  ///< samples that the program has
    double worst = 0;        ///< largest |u + w| of the last solution
  };

  std::vector<double> y_breaks() const;
  std::vector<double> z_breaks() const;
  std::vector<double> z_knots() const;
  std::vector<Row> rows(int parts) const;
  std::vector<double> samples(double y, int refined) const;
  void number_unknowns();
  std::vector<ShapeTerm> shapes(double y, const Row& row) const;
  /// Deviators over strength along x at every y of a row.
  std::vector<std::vector<Vec5>> paths(const Row& row, const std::vector<double>& y, int refined) const;
  void add_points(const Row& row, const std::vector<double>& y, int refined, std::vector<Point>& to) const;
  void choose_samples();
  ConeSolution run(SingleTrack& out);
  /// Program after program until no sample of its points sticks out.
  ConeSolution settled(SingleTrack& out);
  bool add_violated(const ConeSolution& solution);
  std::vector<Point> fine_points(double radius) const;
  bool near_the_limit(double y, double depth, double radius) const;
  /// The points that stick out, into the program; false: none does.
  bool take_in(std::vector<Point>& fine, const ConeSolution& solution);
  void report(const std::vector<Point>& fine, const ConeSolution& solution, SingleTrack& out) const;

  const SingleTrackInput& in_;
  const SingleTrackOptions& options_;
  double width_ = 1;  ///< half-width over half-length
  std::vector<double> y_, z_;
  double reference_ = std::numeric_limits<double>::infinity();  ///< Pa, the least strength
  SplineBasis across_, down_;
  SplineBasis::Unknowns phi_y_, phi_z_, psi_y_, psi_z_;
  std::vector<int> phi_, psi_;  ///< number of an unknown by its places [y * count of z + z]
  int unknowns_ = 0;
  std::vector<Row> rows_;
  std::vector<double> check_y_;
  std::vector<Point> points_;
};

SplineEnd end_of(TrackSides sides, bool left) {
  return sides == TrackSides::endless || (left && sides == TrackSides::symmetric) ? SplineEnd::mirrored
                                                                                  : SplineEnd::open;
}

Track::Track(const SingleTrackInput& in, const SingleTrackOptions& options)
    : in_(in),
      options_(options),
      width_(in.half_width / in.half_length),
      y_(y_breaks()),
      z_(z_breaks()),
      across_(y_, end_of(in.sides, true), end_of(in.sides, false)),
      down_(z_knots(), SplineEnd::open, SplineEnd::open),
      phi_y_(across_.unknowns(false, 2, 2)),
      phi_z_(down_.unknowns(false, 2, 2)),
      psi_y_(across_.unknowns(in.sides != TrackSides::both, 1, 1)),
      psi_z_(down_.unknowns(false, 1, 1)) {
  number_unknowns();
  rows_ = rows(2);
  check_y_ = divided(y_, 2);
  for (const Row& row : rows_)
    if (std::isfinite(row.strength)) reference_ = std::min(reference_, row.strength);
  if (!std::isfinite(reference_)) throw std::invalid_argument("single track: no strength anywhere");
  if (!(reference_ > 0)) throw std::invalid_argument("single track: a shear strength is not positive");
}

std::vector<double> Track::y_breaks() const {
  std::vector<double> right = {0};
  if (in_.sides == TrackSides::endless) {
    for (int i = 1; i <= 4; ++i) right.push_back(0.25 * i);
    return right;
  }
  add_breaks(0, options_.box * width_, 1.4 * width_, options_.cell * width_, right);
  if (in_.sides == TrackSides::symmetric) return right;
  std::vector<double> both;
  for (std::size_t i = right.size() - 1; i > 0; --i) both.push_back(-right[i]);
  both.insert(both.end(), right.begin(), right.end());
  return both;
}

std::vector<double> Track::z_breaks() const {
  const bool line = in_.sides == TrackSides::endless;
  const double shorter = line ? 1 : std::min(1., width_), dense = 1.2 * std::sqrt(shorter);
  std::vector<double> forced;
  for (const double depth : in_.interfaces)
    if (depth / in_.half_length < options_.box * (1 - 1e-6)) forced.push_back(depth / in_.half_length);
  for (const double depth : {0.02, 0.05}) {  // where friction acts
    const bool apart =
        std::all_of(forced.begin(), forced.end(), [&](double f) { return std::abs(f - depth) > 0.0075; });
    if (apart) forced.push_back(depth);
  }
  forced.push_back(options_.box);
  std::sort(forced.begin(), forced.end());
  std::vector<double> breaks = {0};
  for (const double depth : forced) add_breaks(breaks.back(), depth, dense, options_.cell * shorter, breaks);
  return breaks;
}

std::vector<double> Track::z_knots() const {
  std::vector<double> knots = z_;
  for (const double depth : in_.interfaces)
    if (depth / in_.half_length < options_.box * (1 - 1e-6)) knots.push_back(depth / in_.half_length);
  std::sort(knots.begin(), knots.end());
  return knots;
}

std::vector<Row> Track::rows(int parts) const {
  std::vector<Row> all;
  for (const double z : divided(z_, parts)) {
    const auto interface =
        std::find_if(in_.interfaces.begin(), in_.interfaces.end(), [&](double d) { return d / in_.half_length == z; });
    const bool two = interface != in_.interfaces.end();
    const double metres = two ? *interface : z * in_.half_length;
    for (const bool below : {false, true})
      if (two || below) all.push_back({z, metres, two && below, in_.shear_strength(metres, two && below)});
  }
  return all;
}

/// x of a cycle: `refined` times as close as at first.
std::vector<double> Track::samples(double y, int refined) const {
  std::vector<double> x;
  const double step = 0.05 / refined;
  const int n = static_cast<int>(std::lround(1.3 / step));
  for (int i = -n; i <= n; ++i) x.push_back(1.3 * i / n);
  for (int i = 1; i <= 12 * refined; ++i) {  // 12 steps to 4, each 1.22 times the one before
    const double outside = 1.3 + 2.7 * std::expm1(0.2 * i / refined) / std::expm1(0.2 * 12);
    x.push_back(outside);
    x.push_back(-outside);
  }
  std::array<double, 2> ends{};
  if (in_.ends) {
    ends = in_.ends(y * in_.half_length + in_.centre_y);
    for (double& e : ends) e = (e - in_.centre_x) / in_.half_length;
  } else {
    const double t = in_.sides == TrackSides::endless ? 0 : std::min(1., std::abs(y) / width_);
    ends = {-std::sqrt(1 - t * t), std::sqrt(1 - t * t)};
  }
  std::vector<double> offsets = {0, 0.004, 0.012, 0.03, 0.06};
  if (refined > 1) offsets.insert(offsets.end(), {0.002, 0.008, 0.02, 0.045});
  for (const double end : ends)
    for (const double o : offsets) {
      x.push_back(end + o);
      if (o > 0) x.push_back(end - o);
    }
  return x;
}

/// Along the shorter side of the grid first, so that neighbours are close.
void Track::number_unknowns() {
  using Place = std::tuple<int, int, int, int>;  // outer and inner spline, which potential, where its number goes
  std::vector<Place> places;
  const bool z_inside = phi_z_.count <= phi_y_.count;
  const auto add = [&](int which, const SplineBasis::Unknowns& y, const SplineBasis::Unknowns& z,
                       std::vector<int>& of) {
    of.resize(static_cast<std::size_t>(y.count) * z.count);
    for (int i = 0; i < static_cast<int>(y.of.size()); ++i)
      for (int j = 0; j < static_cast<int>(z.of.size()); ++j) {
        if (y.of[i] < 0 || z.of[j] < 0) continue;
        const bool image = std::find(y.of.begin(), y.of.begin() + i, y.of[i]) != y.of.begin() + i;
        if (!image) places.emplace_back(z_inside ? i : j, z_inside ? j : i, which, y.of[i] * z.count + z.of[j]);
      }
  };
  add(0, phi_y_, phi_z_, phi_);
  add(1, psi_y_, psi_z_, psi_);
  std::sort(places.begin(), places.end());
  for (const auto& [outer, inner, which, place] : places) (which == 0 ? phi_ : psi_)[place] = unknowns_++;
}

std::vector<ShapeTerm> Track::shapes(double y, const Row& row) const {
  std::vector<ShapeTerm> terms;
  const SplineTerms phi_z = down_.at(row.depth, row.below, phi_z_), psi_z = down_.at(row.depth, row.below, psi_z_);
  const double f = reference_ / row.strength;
  for (const SplineTerm& a : across_.at(y, false, phi_y_))
    for (const SplineTerm& b : phi_z)
      terms.push_back({.unknown = phi_[a.unknown * phi_z_.count + b.unknown],
                       .component = {0, 4},
                       .value = {0.5 * f * (a.value * b.curvature - a.curvature * b.value), -f * a.slope * b.slope}});
  for (const SplineTerm& a : across_.at(y, false, psi_y_))
    for (const SplineTerm& b : psi_z)
      terms.push_back({.unknown = psi_[a.unknown * psi_z_.count + b.unknown],
                       .component = {3, 2},
                       .value = {f * a.value * b.slope, -f * a.slope * b.value}});
  return terms;
}

std::vector<std::vector<Vec5>> Track::paths(const Row& row, const std::vector<double>& y, int refined) const {
  std::vector<Vec3> at;
  std::vector<std::size_t> begin = {0};
  for (const double v : y) {
    for (const double x : samples(v, refined))
      at.push_back({x * in_.half_length + in_.centre_x, v * in_.half_length + in_.centre_y, row.metres});
    begin.push_back(at.size());
  }
  const std::vector<Sym3> stress = in_.stress(at, row.below);
  if (stress.size() != at.size()) throw std::invalid_argument("single track: a stress for each point was asked for");
  std::vector<std::vector<Vec5>> all(y.size());
  for (std::size_t c = 0; c < y.size(); ++c)
    for (std::size_t i = begin[c]; i < begin[c + 1]; ++i) {
      all[c].push_back(deviator((1 / row.strength) * stress[i]));
      if (!std::isfinite(norm_squared(all[c].back())))
        throw NumericalError("shakedown of a single track: a stress is not a number");
    }
  return all;
}

void Track::add_points(const Row& row, const std::vector<double>& y, int refined, std::vector<Point>& to) const {
  if (y.empty() || !std::isfinite(row.strength)) return;
  std::vector<std::vector<Vec5>> path = paths(row, y, refined);
  for (std::size_t c = 0; c < y.size(); ++c) {
    Point& p = to.emplace_back();
    p.y = y[c];
    p.row = row;
    p.shapes = shapes(y[c], row);
    p.used.assign(path[c].size(), 0);
    p.path = std::move(path[c]);
  }
}

/// The farthest samples from those already there until all lie near one: with these the first round comes close.
void Track::choose_samples() {
  std::vector<double> radius(points_.size());
  for_each(static_cast<std::ptrdiff_t>(points_.size()),
           [&](std::ptrdiff_t p) { radius[p] = enclosing_ball(points_[p].path).radius; });
  const double near = 0.05 * *std::max_element(radius.begin(), radius.end());
  for_each(static_cast<std::ptrdiff_t>(points_.size()), [&](std::ptrdiff_t i) {
    Point& p = points_[i];
    std::vector<double> distance(p.path.size(), std::numeric_limits<double>::infinity());
    std::size_t next = 0;
    for (std::size_t s = 1; s < p.path.size(); ++s)
      if (norm_squared(p.path[s]) > norm_squared(p.path[next])) next = s;
    do {
      const Vec5 from = p.path[next];
      p.used[next] = 1;
      for (std::size_t s = 0; s < p.path.size(); ++s) {
        Vec5 d;
        for (int a = 0; a < 5; ++a) d[a] = p.path[s][a] - from[a];
        distance[s] = std::min(distance[s], norm_squared(d));
      }
      next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    } while (distance[next] > near * near);
  });
}

ConeSolution Track::run(SingleTrack& out) {
  std::vector<ConePoint> program(points_.size());
  int band = 0;
  out.samples = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    program[p].shapes = points_[p].shapes;
    for (std::size_t s = 0; s < points_[p].path.size(); ++s)
      if (points_[p].used[s]) program[p].path.push_back(points_[p].path[s]);
    out.samples += static_cast<int>(program[p].path.size());
    const auto [least, largest] =
        std::minmax_element(program[p].shapes.begin(), program[p].shapes.end(),
                            [](const ShapeTerm& l, const ShapeTerm& r) { return l.unknown < r.unknown; });
    if (least != program[p].shapes.end()) band = std::max(band, largest->unknown - least->unknown);
  }
  ConeSolution solution = solve_cone_program(program, unknowns_, band, options_.accuracy);
  out.iterations = solution.iterations;
  ++out.rounds;
  return solution;
}

ConeSolution Track::settled(SingleTrack& out) {
  ConeSolution solution = run(out);
  while (add_violated(solution)) solution = run(out);
  return solution;
}

/// The path moved by what the potentials leave; the largest |u + w| with the best sigma_x is `worst`.
std::vector<Vec5> moved_path(const std::vector<Vec5>& path, const std::vector<ShapeTerm>& shapes,
                             const std::vector<double>& q, double& worst) {
  assert(std::all_of(shapes.begin(), shapes.end(),
                     [&](const ShapeTerm& t) { return t.unknown < static_cast<int>(q.size()); }));
  Vec5 w{};
  for (const ShapeTerm& t : shapes)
    for (int j = 0; j < 2; ++j) w[t.component[j]] += t.value[j] * q[t.unknown];
  std::vector<Vec5> moved = path;
  for (Vec5& u : moved) u = u + w;
  const EnclosingBall ball = enclosing_ball(moved, free_directions(1));
  for (Vec5& u : moved) u[1] -= ball.centre[1];
  worst = ball.radius;
  return moved;
}

/// Takes in samples that stick out of the ball; false where none does by more than the accuracy.
bool Track::add_violated(const ConeSolution& solution) {
  const double most = solution.radius * (1 + options_.accuracy);
  std::vector<char> added(points_.size(), 0);
  for_each(static_cast<std::ptrdiff_t>(points_.size()), [&](std::ptrdiff_t i) {
    Point& p = points_[i];
    const std::vector<Vec5> moved = moved_path(p.path, p.shapes, solution.unknowns, p.worst);
    if (p.worst <= most) return;
    for (std::size_t s = 0; s < moved.size(); ++s)
      if (!p.used[s] && norm_squared(moved[s]) > solution.radius * solution.radius) p.used[s] = added[i] = 1;
  });
  return std::find(added.begin(), added.end(), 1) != added.end();
}

bool Track::near_the_limit(double y, double depth, double radius) const {
  const auto c = std::lower_bound(check_y_.begin(), check_y_.end(), y) - check_y_.begin();
  const double left = check_y_[std::max<std::ptrdiff_t>(c - 1, 0)], right = check_y_[c];
  double up = 0, down = std::numeric_limits<double>::infinity();
  for (const Row& row : rows_) {
    if (row.depth <= depth) up = row.depth;
    if (row.depth >= depth) down = std::min(down, row.depth);
  }
  return std::any_of(points_.begin(), points_.end(), [&](const Point& p) {
    const double z = p.row.depth;
    return p.y >= left && p.y <= right && z >= up && z <= down && p.worst > 0.8 * radius;
  });
}

/// Twice as close in y, depth and x, where the program's own points come within 0.8 of the limit.
std::vector<Track::Point> Track::fine_points(double radius) const {
  std::vector<Point> fine;
  for (const Row& row : rows(4)) {
    std::vector<double> y;
    for (const double v : divided(y_, 4))
      if (near_the_limit(v, row.depth, radius)) y.push_back(v);
    add_points(row, y, 2, fine);
  }
  return fine;
}

bool Track::take_in(std::vector<Point>& fine, const ConeSolution& solution) {
  constexpr double allowed = 1.003, kept = 0.7;
  const double most = allowed * solution.radius, near = kept * solution.radius;
  for_each(static_cast<std::ptrdiff_t>(fine.size()), [&](std::ptrdiff_t i) {
    Point& p = fine[i];
    const std::vector<Vec5> moved = moved_path(p.path, p.shapes, solution.unknowns, p.worst);
    for (std::size_t s = 0; s < moved.size(); ++s) p.used[s] = norm_squared(moved[s]) > near * near;
  });
  const std::size_t before = points_.size();
  for (const Point& p : fine)
    if (p.worst > most) points_.push_back(p);
  return points_.size() > before;
}

/// The best so far: what every check finds is safe by itself.
void Track::report(const std::vector<Point>& fine, const ConeSolution& solution, SingleTrack& out) const {
  const auto worst =
      std::max_element(fine.begin(), fine.end(), [](const Point& l, const Point& r) { return l.worst < r.worst; });
  if (1 / worst->worst <= out.factor) return;
  out.factor = 1 / worst->worst;
  out.program_factor = 1 / solution.radius;
  out.y = worst->y * in_.half_length + in_.centre_y;
  out.depth = worst->row.metres;
  out.below_interface = worst->row.below;
  out.points.clear();
  for (std::size_t p = 0; p < solution.work.size(); ++p)
    out.points.push_back({.y = points_[p].y * in_.half_length + in_.centre_y,
                          .depth = points_[p].row.metres,
                          .below_interface = points_[p].row.below,
                          .utilisation = points_[p].worst * out.factor,
                          .work = solution.work[p]});
}

SingleTrack Track::solve() {
  constexpr int most_checks = 4;
  SingleTrack out;
  out.unknowns = unknowns_;
  for (const Row& row : rows_) add_points(row, check_y_, 1, points_);
  choose_samples();
  ConeSolution solution = settled(out);
  std::vector<Point> fine = fine_points(solution.radius);
  for (int checks = 1;; ++checks) {
    const bool more = take_in(fine, solution);
    report(fine, solution, out);
    if (!more || checks == most_checks) break;
    solution = settled(out);
  }
  return out;
}

}  // namespace

SingleTrack single_track(const SingleTrackInput& input, const SingleTrackOptions& options) {
  check(input, options);
  return Track(input, options).solve();
}

}  // namespace railstrata
