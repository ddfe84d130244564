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

// Spectra of tables that are odd in x or y are imaginary; their imaginary parts are kept (nx_hat_, ny_hat_).
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
  make_spectra(table_, !whole.nx_hat_.empty());
  if (whole.rows_) rows_ = whole.rows_->part(first_y, nx, ny);
  if (!whole.turns()) return;
  const auto rows_of = [&](const Plane& by_row) {
    return Plane(by_row.begin() + first_y, by_row.begin() + first_y + ny);
  };
  set_turns(rows_of(whole.cosine_), rows_of(whole.sine_));
}

InfluenceOperator::InfluenceOperator(const InfluenceOperator& flat, const Plane& turn)
    : fft_(flat.nx(), flat.ny()), film_(flat.film_), table_(flat.table_) {
  make_spectra(table_, !flat.nx_hat_.empty());
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
  for (std::size_t k = 0; k < nn_hat_.size(); ++k) mean_hat_.push_back(0.5 * (nn_hat_[k] + yy_hat_[k]));
}

InfluenceOperator::InfluenceOperator(const InfluenceOperator& flat, std::shared_ptr<const RowsDifference> rows,
                                     const SurfaceCompliance& wheel, double curvature, double dx, double dy)
    : fft_(flat.nx(), flat.ny()),
      film_(flat.film_),
      table_(flat.table_),
      rows_(std::move(rows)),
      turn_(curvature * dx) {
  make_spectra(table_, !flat.nx_hat_.empty());
  wheel_nn_hat_ = fft_.spectrum(component(influence_table(wheel, fft_, dx, dy, false), &RectangleInfluence::nn), 1, 1);
}

std::shared_ptr<const InfluenceOperator> InfluenceOperator::part(int nx, int ny, int first_y) const {
  constexpr std::size_t kMost = 16;
  if (!rows_ && !turns()) first_y = 0;
  const std::lock_guard lock(parts_mutex_);
  for (const Part& part : parts_)
    if (part.op->nx() == nx && part.op->ny() == ny && part.first_y == first_y) return part.op;
  if (parts_.size() == kMost) parts_.erase(parts_.begin());
  parts_.push_back({first_y, std::shared_ptr<const InfluenceOperator>(new InfluenceOperator(*this, nx, ny, first_y))});
  return parts_.back().op;
}

void InfluenceOperator::make_spectra(std::vector<RectangleInfluence> table, bool couples) {
  table[0].xx += film_;
  table[0].yy += film_;
  using I = RectangleInfluence;
  near_[0] = table[0];
  near_[1] = table[fft_.my() / 2 + 1];  // the table has index j + (my/2 + 1) i
  nn_hat_ = fft_.spectrum(component(table, &I::nn), 1, 1);
  xx_hat_ = fft_.spectrum(component(table, &I::xx), 1, 1);
  xy_hat_ = fft_.spectrum(component(table, &I::xy), -1, -1);
  yy_hat_ = fft_.spectrum(component(table, &I::yy), 1, 1);
  if (couples) {
    nx_hat_ = fft_.spectrum(component(table, &I::nx), -1, 1);
    ny_hat_ = fft_.spectrum(component(table, &I::ny), 1, -1);
  }
  // Inverses wave by wave on the periodic grid. The mean wave and, near Poisson's ratio 1/2 or for thin soft layers,
  // the determinant can come close to zero there, though the operator itself is positive: floors keep the inverses
  // positive definite, which the solvers need; how exact they are only changes the number of iterations.
  const std::size_t n = fft_.spectrum_size();
  for (auto* v : {&inv_nn_, &inv_xx_, &inv_xy_, &inv_yy_}) v->assign(n, 0.0);
  const double points = static_cast<double>(fft_.mx()) * fft_.my(), scale = 1 / (points * points);
  const double floor_nn = 1e-6 * *std::max_element(nn_hat_.begin(), nn_hat_.end());
  for (std::size_t k = 0; k < n; ++k) {
    inv_nn_[k] = scale / std::max(nn_hat_[k], floor_nn);
    const double trace = 0.5 * (xx_hat_[k] + yy_hat_[k]);
    if (trace <= 0) continue;  // padding columns of the last block
    const double det = std::max(xx_hat_[k] * yy_hat_[k] - xy_hat_[k] * xy_hat_[k], 1e-3 * trace * trace);
    inv_xx_[k] = scale * yy_hat_[k] / det;
    inv_xy_[k] = -scale * xy_hat_[k] / det;
    inv_yy_[k] = scale * xx_hat_[k] / det;
  }
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
    add_component(cosine_, p, nn_hat_, u_n, nx());
    add_component(sine_, p, nn_hat_, u_n, nx());
    return;
  }
  fft_.apply({p}, {u_n}, nx(), ScalarProduct{nn_hat_.data()});
  if (rows_) rows_->add({nullptr, nullptr, p}, {nullptr, nullptr, u_n}, nx());
}

void InfluenceOperator::precondition_normal(const double* u_n, double* p) const {
  fft_.apply({u_n}, {p}, nx(), ScalarProduct{inv_nn_.data()});
}

void InfluenceOperator::turned_tangential(const double* q_x, const double* q_y, double* u_x, double* u_y,
                                          int rows) const {
  Plane along = plane_of(nx());
  for (std::size_t k = 0; k < along.size(); ++k) along[k] = cosine_[k % cosine_.size()] * q_y[k];
  fft_.apply({q_x, along.data()}, {u_x, u_y}, rows, SymmetricProduct{xx_hat_.data(), xy_hat_.data(), yy_hat_.data()});
  for (std::size_t k = 0; k < plane_of(rows).size(); ++k) u_y[k] *= cosine_[k % cosine_.size()];
  add_component(sine_, q_y, yy_hat_, u_y, rows);
}

void InfluenceOperator::tangential(const double* q_x, const double* q_y, double* u_x, double* u_y, int rows) const {
  stop_if_requested();
  if (turns()) return turned_tangential(q_x, q_y, u_x, u_y, rows);
  fft_.apply({q_x, q_y}, {u_x, u_y}, rows, SymmetricProduct{xx_hat_.data(), xy_hat_.data(), yy_hat_.data()});
  if (rows_) rows_->add({q_x, q_y, nullptr}, {u_x, u_y, nullptr}, rows);
}

PlanePair InfluenceOperator::tangential(const Plane& q_x, const Plane& q_y, int rows) const {
  PlanePair u{plane_of(rows), plane_of(rows)};
  tangential(q_x.data(), q_y.data(), u.x.data(), u.y.data(), rows);
  return u;
}

void InfluenceOperator::precondition_tangential(const double* u_x, const double* u_y, double* q_x, double* q_y) const {
  fft_.apply({u_x, u_y}, {q_x, q_y}, nx(), SymmetricProduct{inv_xx_.data(), inv_xy_.data(), inv_yy_.data()});
}

// A ring whose surface moves by u_n towards the axle is shorter: a particle's velocity along the surface loses u_n over
// the radius beside the gradient of its displacement along it. As a displacement: that integrated along x.
void InfluenceOperator::add_stretch_of_wheel(const Plane& p, Plane& u_x) const {
  Plane inward(u_x.size());
  const auto n = static_cast<std::size_t>(ny());
  const int rows = static_cast<int>(u_x.size() / n);
  fft_.apply({p.data()}, {inward.data()}, rows, ScalarProduct{wheel_nn_hat_.data()});
  rows_->add_of_wheel(p.data(), inward.data(), rows);
  Plane sum(n, 0.0);
  for (std::size_t k = n; k < u_x.size(); ++k) u_x[k] += sum[k % n] += 0.5 * turn_ * (inward[k - n] + inward[k]);
}

PlanePair InfluenceOperator::tangential_from_pressure(const Plane& p, int rows) const {
  PlanePair u{plane_of(rows), plane_of(rows)};
  if (!nx_hat_.empty())
    fft_.apply({p.data()}, {u.x.data(), u.y.data()}, rows,
               [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
                 Complex *a = z[0], *b = z[1];
                 for (int k = 0; k < count; ++k) {
                   const std::size_t i = first + static_cast<std::size_t>(k);
                   const Complex ip = times_i(a[k]);
                   a[k] = -nx_hat_[i] * ip;
                   b[k] = -ny_hat_[i] * ip;
                 }
               });
  if (turns()) add_scaled(u.y, -1, across_turns(p.data(), rows));
  if (!rows_) return u;
  rows_->add({nullptr, nullptr, p.data()}, {u.x.data(), u.y.data(), nullptr}, rows);
  add_stretch_of_wheel(p, u.x);
  return u;
}

Plane InfluenceOperator::normal_from_traction(const Plane& q_x, const Plane& q_y) const {
  Plane u = plane_of(nx());
  if (!nx_hat_.empty())
    fft_.apply({q_x.data(), q_y.data()}, {u.data()}, nx(),
               [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
                 Complex *a = z[0], *b = z[1];
                 for (int k = 0; k < count; ++k) {
                   const std::size_t i = first + static_cast<std::size_t>(k);
                   a[k] = times_i(nx_hat_[i] * a[k] + ny_hat_[i] * b[k]);
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
  constexpr std::size_t kEntries = 32;
  SurfaceCompliance pair;
  {
    const std::lock_guard lock(mutex_);
    for (auto it = entries_.begin(); it != entries_.end(); ++it) {
      if (!same(it->wheel, wheel) || !same(it->rail, rail)) continue;
      pair = it->pair;
      if (!same_cells(it->grid, g) || it->film != film) continue;
      entries_.splice(entries_.begin(), entries_, it);
      return it->op;
    }
  }
  if (pair.empty()) pair = combined_compliance(layered_compliance(wheel), layered_compliance(rail));
  auto op = std::make_shared<const InfluenceOperator>(pair, g.nx, g.ny, g.dx, g.dy, film, g.line);
  const std::lock_guard lock(mutex_);
  entries_.push_front({wheel, rail, g, film, std::move(pair), op});
  if (entries_.size() > kEntries) entries_.pop_back();
  return op;
}

std::shared_ptr<const InfluenceOperator> InfluenceCache::get(const LayeredHalfSpace& wheel,
                                                             const LayeredHalfSpace& rail, const PatchGrid& g,
                                                             double film, const SectionsAsked& sections) {
  const std::shared_ptr<const InfluenceOperator> flat = get(wheel, rail, g, film);
  const auto& [spec, placement] = sections;
  const RigidContact& contact = placement.contact;
  const PlacedRemainder of_rail{sections_->get(spec, placement, BodyId::rail, rail, g),
                                rail_to_model(placement.track, placement.rail.at(contact.rail_s).position),
                                contact.angle},
      of_wheel{sections_->get(spec, placement, BodyId::wheel, wheel, g),
               placement.wheel.at(contact.wheel_s).position - Vec2{0, spec.geometry.wheel_radius},
               contact.angle - contact.roll};
  return std::make_shared<const InfluenceOperator>(*flat, std::make_shared<const RowsDifference>(of_rail, of_wheel, g),
                                                   layered_compliance(wheel),
                                                   std::cos(of_wheel.angle) / contact.rolling_radius, g.dx, g.dy);
}

}  // namespace railstrata
