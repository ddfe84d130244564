#include "bem/influence_operator.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "bem/rows_difference.hpp"
#include "core/stop_request.hpp"
#include "halfspace/line_contact.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;

std::vector<double> component(const std::vector<RectangleInfluence>& table, double RectangleInfluence::*member) {
  std::vector<double> out(table.size());
  std::transform(table.begin(), table.end(), out.begin(), [&](const RectangleInfluence& t) { return t.*member; });
  return out;
}

bool couples_at_all(const SurfaceCompliance& pair) {
  double rz = 0, zz = 0;
  for (const ComplianceImage& image : pair) {
    rz = std::max(rz, std::abs(image.c.rz));
    zz = std::max(zz, std::abs(image.c.zz));
  }
  return rz > 1e-12 * zz;
}

std::vector<RectangleInfluence> influence_table(const SurfaceCompliance& pair, const PlaneFft& fft, double dx,
                                                double dy, bool line) {
  const int nx = fft.mx() / 2 + 1, ny = fft.my() / 2 + 1;
  return line ? in_first_column(strip_influence_table(pair, nx, dx), ny)
              : rectangle_influence_table(pair, nx, ny, dx, dy);
}

bool same(const LayeredHalfSpace& a, const LayeredHalfSpace& b) {
  return a.substrate == b.substrate && std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                                                  [](const HalfSpaceLayer& one, const HalfSpaceLayer& other) {
                                                    return one.thickness == other.thickness &&
                                                           one.material == other.material && one.bond == other.bond;
                                                  });
}

/// Wherever they lie.
bool same_cells(const PatchGrid& a, const PatchGrid& b) {
  return a.nx == b.nx && a.ny == b.ny && a.dx == b.dx && a.dy == b.dy && a.line == b.line;
}

struct ScalarProduct {
  const double* s;
  void operator()(std::size_t first, int count, const PlaneFft::Spectra& z) const {
    for (int k = 0; k < count; ++k) z[0][k] *= s[first + static_cast<std::size_t>(k)];
  }
};

struct SymmetricProduct {
  const double *xx, *xy, *yy;
  void operator()(std::size_t first, int count, const PlaneFft::Spectra& z) const {
    Complex *a = z[0], *b = z[1];
    for (int k = 0; k < count; ++k) {
      const std::size_t i = first + static_cast<std::size_t>(k);
      const Complex u = a[k], v = b[k];
      a[k] = xx[i] * u + xy[i] * v;
      b[k] = xy[i] * u + yy[i] * v;
    }
  }
};

// Spectra of tables that are odd in x or y are imaginary; their imaginary parts are kept (nx, ny).
Complex times_i(Complex z) { return {-z.imag(), z.real()}; }

}  // namespace

InfluenceOperator::InfluenceOperator(const SurfaceCompliance& pair, int nx, int ny, double dx, double dy, double film,
                                     bool line)
    : fft_(nx, ny), film_(film), table_(influence_table(pair, fft_, dx, dy, line)) {
  make_spectra(table_, couples_at_all(pair));
}

InfluenceOperator::InfluenceOperator(const InfluenceOperator& whole, int nx, int ny, int first_y)
    : fft_(nx, ny), film_(whole.film_) {
  const std::size_t columns = static_cast<std::size_t>(fft_.my() / 2 + 1),
                    columns_of_whole = static_cast<std::size_t>(whole.fft_.my() / 2 + 1);
  for (int i = 0; i <= fft_.mx() / 2; ++i) {
    const auto row = whole.table_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * columns_of_whole);
    table_.insert(table_.end(), row, row + static_cast<std::ptrdiff_t>(columns));
  }
  make_spectra(table_, !whole.spectra_->nx.empty());
  if (!whole.turns()) return;
  const auto rows_of = [&](const Plane& by_row) {
    return Plane(by_row.begin() + first_y, by_row.begin() + first_y + ny);
  };
  set_turns(rows_of(whole.cosine_), rows_of(whole.sine_));
}

InfluenceOperator::InfluenceOperator(const InfluenceOperator& flat, const Plane& turn)
    : fft_(flat.nx(), flat.ny()),
      film_(flat.film_),
      near_{flat.near_[0], flat.near_[1]},
      table_(flat.table_),
      spectra_(flat.spectra_) {
  Plane cosine, sine;
  for (const double angle : turn) {
    cosine.push_back(std::cos(angle));
    sine.push_back(std::sin(angle));
  }
  set_turns(cosine, sine);
}

void InfluenceOperator::set_turns(const Plane& cosine, const Plane& sine) {
  cosine_ = cosine;
  sine_ = sine;
  for (std::size_t k = 0; k < spectra_->nn.size(); ++k) mean_hat_.push_back(0.5 * (spectra_->nn[k] + spectra_->yy[k]));
}

InfluenceOperator::InfluenceOperator(std::shared_ptr<const InfluenceOperator> flat,
                                     std::shared_ptr<const RowsDifference> rows,
                                     std::shared_ptr<const InfluenceOperator> wheel, double curvature)
    : fft_(flat->nx(), flat->ny()),
      film_(flat->film_),
      near_{flat->near_[0], flat->near_[1]},
      spectra_(flat->spectra_),
      flat_(std::move(flat)),
      wheel_(std::move(wheel)),
      rows_(std::move(rows)),
      curvature_(curvature) {}

std::shared_ptr<const InfluenceOperator> InfluenceOperator::part(int nx, int ny, int first_y) const {
  constexpr std::size_t kMost = 16;
  if (!rows_ && !turns()) first_y = 0;
  const std::lock_guard lock(parts_mutex_);
  for (const Part& part : parts_)
    if (part.op->nx() == nx && part.op->ny() == ny && part.first_y == first_y) return part.op;
  if (parts_.size() == kMost) parts_.erase(parts_.begin());
  std::shared_ptr<const InfluenceOperator> made;
  if (rows_)
    made = std::make_shared<const InfluenceOperator>(flat_->part(nx, ny, 0), rows_->part(first_y, nx, ny),
                                                     wheel_->part(nx, ny, 0), curvature_);
  else
    made = std::shared_ptr<const InfluenceOperator>(new InfluenceOperator(*this, nx, ny, first_y));
  parts_.push_back({first_y, std::move(made)});
  return parts_.back().op;
}

void InfluenceOperator::make_spectra(std::vector<RectangleInfluence> table, bool couples) {
  table[0].xx += film_;
  table[0].yy += film_;
  using I = RectangleInfluence;
  Spectra s;
  near_[0] = table[0];
  near_[1] = table[fft_.my() / 2 + 1];  // the table has index j + (my/2 + 1) i
  s.nn = fft_.spectrum(component(table, &I::nn), 1, 1);
  s.xx = fft_.spectrum(component(table, &I::xx), 1, 1);
  s.xy = fft_.spectrum(component(table, &I::xy), -1, -1);
  s.yy = fft_.spectrum(component(table, &I::yy), 1, 1);
  if (couples) {
    s.nx = fft_.spectrum(component(table, &I::nx), -1, 1);
    s.ny = fft_.spectrum(component(table, &I::ny), 1, -1);
  }
  // Inverses wave by wave on the periodic grid. The mean wave and, near Poisson's ratio 1/2 or for thin soft layers,
  // the determinant can come close to zero there, though the operator itself is positive: floors keep the inverses
  // positive definite, which the solvers need; how exact they are only changes the number of iterations.
  const std::size_t n = fft_.spectrum_size();
  for (auto* v : {&s.inv_nn, &s.inv_xx, &s.inv_xy, &s.inv_yy}) v->assign(n, 0.0);
  const double points = static_cast<double>(fft_.mx()) * fft_.my(), scale = 1 / (points * points);
  const double floor_nn = 1e-6 * *std::max_element(s.nn.begin(), s.nn.end());
  for (std::size_t k = 0; k < n; ++k) {
    s.inv_nn[k] = scale / std::max(s.nn[k], floor_nn);
    const double trace = 0.5 * (s.xx[k] + s.yy[k]);
    if (trace <= 0) continue;  // padding columns of the last block
    const double det = std::max(s.xx[k] * s.yy[k] - s.xy[k] * s.xy[k], 1e-3 * trace * trace);
    s.inv_xx[k] = scale * s.yy[k] / det;
    s.inv_xy[k] = -scale * s.xy[k] / det;
    s.inv_yy[k] = scale * s.xx[k] / det;
  }
  spectra_ = std::make_shared<const Spectra>(std::move(s));
}

void InfluenceOperator::add_component(const Plane& by_row, const double* in, const std::vector<double>& spectrum,
                                      double* out, int rows) const {
  Plane own = plane_of(nx()), moved = plane_of(rows);
  for (std::size_t k = 0; k < own.size(); ++k) own[k] = by_row[k % by_row.size()] * in[k];
  fft_.apply({own.data()}, {moved.data()}, rows, ScalarProduct{spectrum.data()});
  for (std::size_t k = 0; k < moved.size(); ++k) out[k] += by_row[k % by_row.size()] * moved[k];
}

Plane InfluenceOperator::across_turns(const double* in, int rows) const {
  Plane along = plane_of(nx()), up = along, moved_along = plane_of(rows), moved_up = moved_along;
  for (std::size_t k = 0; k < along.size(); ++k) {
    along[k] = cosine_[k % cosine_.size()] * in[k];
    up[k] = sine_[k % sine_.size()] * in[k];
  }
  fft_.apply({along.data()}, {moved_along.data()}, rows, ScalarProduct{mean_hat_.data()});
  fft_.apply({up.data()}, {moved_up.data()}, rows, ScalarProduct{mean_hat_.data()});
  for (std::size_t k = 0; k < moved_along.size(); ++k)
    moved_along[k] = sine_[k % sine_.size()] * moved_along[k] - cosine_[k % cosine_.size()] * moved_up[k];
  return moved_along;
}

void InfluenceOperator::normal(const double* p, double* u_n) const {
  stop_if_requested();
  if (turns()) {
    std::fill_n(u_n, static_cast<std::size_t>(nx()) * cosine_.size(), 0.0);
    add_component(cosine_, p, spectra_->nn, u_n, nx());
    add_component(sine_, p, spectra_->nn, u_n, nx());
    return;
  }
  fft_.apply({p}, {u_n}, nx(), ScalarProduct{spectra_->nn.data()});
  if (rows_) rows_->add({nullptr, nullptr, p}, {nullptr, nullptr, u_n}, nx());
}

void InfluenceOperator::precondition_normal(const double* u_n, double* p) const {
  fft_.apply({u_n}, {p}, nx(), ScalarProduct{spectra_->inv_nn.data()});
}

void InfluenceOperator::turned_tangential(const double* q_x, const double* q_y, double* u_x, double* u_y,
                                          int rows) const {
  Plane along = plane_of(nx());
  for (std::size_t k = 0; k < along.size(); ++k) along[k] = cosine_[k % cosine_.size()] * q_y[k];
  fft_.apply({q_x, along.data()}, {u_x, u_y}, rows,
             SymmetricProduct{spectra_->xx.data(), spectra_->xy.data(), spectra_->yy.data()});
  for (std::size_t k = 0; k < plane_of(rows).size(); ++k) u_y[k] *= cosine_[k % cosine_.size()];
  add_component(sine_, q_y, spectra_->yy, u_y, rows);
}

void InfluenceOperator::tangential(const double* q_x, const double* q_y, double* u_x, double* u_y, int rows) const {
  stop_if_requested();
  if (turns()) return turned_tangential(q_x, q_y, u_x, u_y, rows);
  fft_.apply({q_x, q_y}, {u_x, u_y}, rows,
             SymmetricProduct{spectra_->xx.data(), spectra_->xy.data(), spectra_->yy.data()});
  if (rows_) rows_->add({q_x, q_y, nullptr}, {u_x, u_y, nullptr}, rows);
}

PlanePair InfluenceOperator::tangential(const Plane& q_x, const Plane& q_y, int rows) const {
  PlanePair u{plane_of(rows), plane_of(rows)};
  tangential(q_x.data(), q_y.data(), u.x.data(), u.y.data(), rows);
  return u;
}

void InfluenceOperator::precondition_tangential(const double* u_x, const double* u_y, double* q_x, double* q_y) const {
  fft_.apply({u_x, u_y}, {q_x, q_y}, nx(),
             SymmetricProduct{spectra_->inv_xx.data(), spectra_->inv_xy.data(), spectra_->inv_yy.data()});
}

Plane InfluenceOperator::stretch_of_wheel(const Plane& p, int rows) const {
  Plane out = plane_of(rows);
  wheel_->fft_.apply({p.data()}, {out.data()}, rows, ScalarProduct{wheel_->spectra_->nn.data()});
  rows_->add_of_wheel(p.data(), out.data(), rows);
  for (double& inward : out) inward *= curvature_;
  return out;
}

Plane InfluenceOperator::stretch_by_rotation(double speed) const {
  const double turned = speed * curvature_;
  const Eigen::VectorXd stretch = curvature_ * turned * turned * rows_->by_rotation();
  return {stretch.begin(), stretch.end()};
}

double InfluenceOperator::stretch_by_load() const { return rows_ ? rows_->stretch_by_load() : 0; }

PlanePair InfluenceOperator::tangential_from_pressure(const Plane& p, int rows) const {
  PlanePair u{plane_of(rows), plane_of(rows)};
  if (!spectra_->nx.empty())
    fft_.apply({p.data()}, {u.x.data(), u.y.data()}, rows,
               [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
                 Complex *a = z[0], *b = z[1];
                 for (int k = 0; k < count; ++k) {
                   const std::size_t i = first + static_cast<std::size_t>(k);
                   const Complex ip = times_i(a[k]);
                   a[k] = -spectra_->nx[i] * ip;
                   b[k] = -spectra_->ny[i] * ip;
                 }
               });
  if (turns()) add_scaled(u.y, -1, across_turns(p.data(), rows));
  if (rows_) rows_->add({nullptr, nullptr, p.data()}, {u.x.data(), u.y.data(), nullptr}, rows);
  return u;
}

Plane InfluenceOperator::normal_from_traction(const Plane& q_x, const Plane& q_y) const {
  Plane u = plane_of(nx());
  if (!spectra_->nx.empty())
    fft_.apply({q_x.data(), q_y.data()}, {u.data()}, nx(),
               [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
                 Complex *a = z[0], *b = z[1];
                 for (int k = 0; k < count; ++k) {
                   const std::size_t i = first + static_cast<std::size_t>(k);
                   a[k] = times_i(spectra_->nx[i] * a[k] + spectra_->ny[i] * b[k]);
                 }
               });
  if (turns()) add_scaled(u, 1, across_turns(q_y.data(), nx()));
  if (rows_) rows_->add({q_x.data(), q_y.data(), nullptr}, {nullptr, nullptr, u.data()}, nx());
  return u;
}

InfluenceCache::InfluenceCache() : sections_(std::make_shared<SectionStore>()) {}

std::shared_ptr<const InfluenceOperator> InfluenceCache::get(const LayeredHalfSpace& wheel,
                                                             const LayeredHalfSpace& rail, const PatchGrid& g,
                                                             double film) {
  return flat(wheel, &rail, g, film);
}

std::shared_ptr<const InfluenceOperator> InfluenceCache::flat(const LayeredHalfSpace& wheel,
                                                              const LayeredHalfSpace* rail, const PatchGrid& g,
                                                              double film) {
  constexpr std::size_t kEntries = 32;
  SurfaceCompliance pair;
  {
    const std::lock_guard lock(mutex_);
    for (auto it = entries_.begin(); it != entries_.end(); ++it) {
      if (!same(it->wheel, wheel) || it->rail.has_value() != (rail != nullptr) || (rail && !same(*it->rail, *rail)))
        continue;
      pair = it->pair;
      if (!same_cells(it->grid, g) || it->film != film) continue;
      entries_.splice(entries_.begin(), entries_, it);
      return it->op;
    }
  }
  if (pair.empty())
    pair = rail ? combined_compliance(layered_compliance(wheel), layered_compliance(*rail)) : layered_compliance(wheel);
  auto op = std::make_shared<const InfluenceOperator>(pair, g.nx, g.ny, g.dx, g.dy, film, g.line);
  const std::lock_guard lock(mutex_);
  entries_.push_front(
      {wheel, rail ? std::optional<LayeredHalfSpace>(*rail) : std::nullopt, g, film, std::move(pair), op});
  if (entries_.size() > kEntries) entries_.pop_back();
  return op;
}

std::shared_ptr<const InfluenceOperator> InfluenceCache::get(const LayeredHalfSpace& wheel,
                                                             const LayeredHalfSpace& rail, const PatchGrid& g,
                                                             double film, const SectionsAsked& sections) {
  const auto& [spec, placement] = sections;
  const PlacedRemainder of_rail{sections_->get(spec, placement, BodyId::rail, rail, g),
                                section_plane(spec, placement, BodyId::rail)},
      of_wheel{sections_->get(spec, placement, BodyId::wheel, wheel, g), section_plane(spec, placement, BodyId::wheel)};
  return std::make_shared<const InfluenceOperator>(
      flat(wheel, &rail, g, film), std::make_shared<const RowsDifference>(of_rail, of_wheel, g),
      flat(wheel, nullptr, g, 0), std::cos(of_wheel.plane.angle) / placement.contact.rolling_radius);
}

}  // namespace railstrata
