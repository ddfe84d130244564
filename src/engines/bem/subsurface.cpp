#include "bem/subsurface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "bem/layer_correction.hpp"
#include "bem/section_below.hpp"
#include "core/stop_request.hpp"
#include "halfspace/line_contact.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;

/// Parity of an influence in x and in y: +1 even, -1 odd.
struct Parity {
  int x, y;
};

constexpr std::size_t kStates = 6;
constexpr std::array<double InteriorState::*, kStates> kState{&InteriorState::e_xx, &InteriorState::e_yy,
                                                              &InteriorState::e_xy, &InteriorState::s_xz,
                                                              &InteriorState::s_yz, &InteriorState::s_zz};
/// Under p, q_x, q_y.
constexpr Parity kParity[3][kStates] = {{{1, 1}, {1, 1}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}},
                                        {{-1, 1}, {-1, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}},
                                        {{1, -1}, {1, -1}, {-1, 1}, {-1, -1}, {1, 1}, {1, -1}}};
constexpr std::array<double Vec3::*, 3> kAxis{&Vec3::x, &Vec3::y, &Vec3::z};
constexpr Parity kDisplacementParity[3][3] = {
    {{-1, 1}, {1, -1}, {1, 1}}, {{1, 1}, {-1, -1}, {-1, 1}}, {{-1, -1}, {1, 1}, {1, -1}}};

/// Spectra of a table, by load (p, q_x, q_y) and s: value(entry, load, s) is the influence at an offset from a cell.
/// The table holds the quadrant x, y >= 0 alone; the parities complete it.
template <std::size_t N, class Table, class Value>
std::vector<Plane> spectra_of(const PlaneFft& fft, const Table& table, const Parity (&parity)[3][N], Value&& value) {
  std::vector<PlaneFft::KernelTable> tables;
  for (std::size_t load = 0; load < 3; ++load)
    for (std::size_t s = 0; s < N; ++s) {
      Plane& values = tables.emplace_back(PlaneFft::KernelTable{{}, parity[load][s].x, parity[load][s].y}).values;
      values.resize(table.size());
      for (std::size_t i = 0; i < table.size(); ++i) values[i] = value(table[i], load, s);
    }
  return fft.spectra(std::move(tables));
}

/// The planes s of `out` = sum over the loads (p, q_x, q_y) of kernel times load. A spectrum is real where both
/// parities agree, else imaginary with its imaginary part kept: hence the two products below.
template <std::size_t N, class Planes>
void convolve(const PlaneFft& fft, const PlaneLoads& loads, const std::vector<Plane>& hat, const Parity (&parity)[3][N],
              Planes& out) {
  const std::vector<const double*> in{loads.p.data(), loads.q_x.data(), loads.q_y.data()};
  fft.apply(in, cleared(out, loads.p.size()), fft.nx(), [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
    for (int k = 0; k < count; ++k) {
      const Complex load[3] = {z[0][k], z[1][k], z[2][k]};
      for (std::size_t s = 0; s < N; ++s) {
        Complex sum = 0;
        for (std::size_t l = 0; l < 3; ++l) {
          const double h = hat[l * N + s][first + static_cast<std::size_t>(k)];
          sum += parity[l][s].x * parity[l][s].y > 0 ? h * load[l] : Complex(-h * load[l].imag(), h * load[l].real());
        }
        z[s][k] = sum;
      }
    }
  });
}

}  // namespace

std::shared_ptr<const InteriorKernels::Spectra> InteriorKernels::get(const Key& key,
                                                                     const std::function<Spectra()>& make) {
  constexpr std::size_t kMost = 32 << 20;  // numbers: 256 MiB
  {
    const std::lock_guard lock(mutex_);
    if (const auto it = kept_.find(key); it != kept_.end()) return it->second;
  }
  auto made = std::make_shared<const Spectra>(make());
  std::size_t numbers = 0;
  for (const Plane& one : *made) numbers += one.size();
  const std::lock_guard lock(mutex_);
  if (numbers_ + numbers > kMost) {
    kept_.clear();
    numbers_ = 0;
  }
  if (kept_.emplace(key, made).second) numbers_ += numbers;
  return made;
}

Subsurface::Subsurface(const LayeredHalfSpace& body, const PatchGrid& grid, Plane p, Plane q_x, Plane q_y,
                       double period)
    : body_(body),
      grid_(grid),
      loads_{std::move(p), std::move(q_x), std::move(q_y)},
      period_(period),
      reach_x_(grid.nx),
      reach_y_(grid.ny) {
  assert(loads_.p.size() == grid.size() && loads_.q_x.size() == grid.size() && loads_.q_y.size() == grid.size());
  if (!body_.layers.empty()) layered_ = std::make_unique<LayerCorrection>(body_, grid_, period_);
}

Subsurface::~Subsurface() = default;
Subsurface::Subsurface(Subsurface&&) noexcept = default;

void Subsurface::stand_on(std::unique_ptr<const SectionBelow> section) {
  section_ = std::move(section);
  if (!section_->in_full()) return;
  layered_.reset();
  extents_ = layer_extents(body_);
}

void Subsurface::follow(const Subsurface& whole) {
  kernels_ = whole.kernels_;
  if (whole.section_) stand_on(whole.section_->on(grid_));
}

bool Subsurface::gives_at(double depth) const {
  double bottom = 0;
  return std::any_of(body_.layers.begin(), body_.layers.end(), [&](const HalfSpaceLayer& layer) {
    bottom += layer.thickness;
    return bottom == depth && layer.bond.gives();
  });
}

StatePlane Subsurface::plane(double depth) const {
  StatePlane out = plane(depth, false);
  if (gives_at(depth)) out.lower = std::make_shared<const StatePlane>(plane(depth, true));
  return out;
}

StatePlane Subsurface::plane(double depth, bool below_interface) const {
  stop_if_requested();
  StatePlane out;
  out.depth = depth;
  const PlaneFft fft(grid_.nx, grid_.ny, reach_x_, reach_y_);
  const int nx = fft.mx() / 2 + 1, ny = fft.my() / 2 + 1;
  const auto make = [&] {
    const auto table = grid_.line ? in_first_column(strip_interior_table(body_.substrate, depth, nx, grid_.dx), ny)
                                  : rectangle_interior_table(body_.substrate, depth, nx, ny, grid_.dx, grid_.dy);
    return spectra_of(fft, table, kParity,
                      [](const InteriorInfluence& t, std::size_t load, std::size_t s) { return t[load].*kState[s]; });
  };
  if (kernels_)
    convolve(fft, loads_,
             *kernels_->get({body_.substrate.young, body_.substrate.poisson, depth, grid_.dx, grid_.dy, fft.mx(),
                             fft.my(), grid_.line},
                            make),
             kParity, out);
  else
    convolve(fft, loads_, make(), kParity, out);
  straighten_steps(depth, out);
  if (layered_) {
    stop_if_requested();
    layered_->add(loads_, below_interface, out);
  }
  if (section_) section_->add(out);
  return out;
}

DisplacementPlane Subsurface::displacement(double depth, bool below_interface) const {
  DisplacementPlane out;
  out.depth = depth;
  if (grid_.line) {
    for (Plane* u : planes_of(out)) u->assign(grid_.size(), std::numeric_limits<double>::quiet_NaN());
    return out;
  }
  const PlaneFft fft(grid_.nx, grid_.ny, reach_x_, reach_y_);
  const auto table =
      rectangle_displacement_table(body_.substrate, depth, fft.mx() / 2 + 1, fft.my() / 2 + 1, grid_.dx, grid_.dy);
  const auto value = [](const InteriorDisplacement& t, std::size_t load, std::size_t axis) {
    return t[load].*kAxis[axis];
  };
  convolve(fft, loads_, spectra_of(fft, table, kDisplacementParity, value), kDisplacementParity, out);
  if (layered_) {
    stop_if_requested();
    layered_->add(loads_, below_interface, out);
  }
  return out;
}

void Subsurface::straighten_steps(double depth, StatePlane& out) const {
  // Tractions constant in each cell differ from linear ones by a sawtooth of the slope. Its waves are k_n = 2 pi n/d
  // with amplitudes (-1)^n/n; at a depth z each carries exp(-k_n z), times k_n z in the terms of the half-space
  // solution that grow with depth. With r = exp(-2 pi z/d) the sums over n at the cell's middle are
  //   sum of -(-r)^n/n = ln(1 + r) ("alternating"),   sum of -(-r)^n = r/(1 + r) ("once"),
  // and a cell below the surface 0.2 % of it is left. Cells at the grid's rim have no neighbour and carry no traction.
  const double G = body_.substrate.shear(), nu = body_.substrate.poisson;
  struct Tooth {
    double normal_strain, shear_strain, s_zz;  // per unit slope of the traction
  };
  const auto tooth = [&](double d) {
    const double r = std::exp(-2 * std::numbers::pi * depth / d), alternating = std::log1p(r), once = r / (1 + r);
    return Tooth{
        d / (2 * std::numbers::pi * G) * (2 * (1 - nu) * alternating - 2 * std::numbers::pi * depth / d * once),
        d / (2 * std::numbers::pi * G) * alternating, 2 * depth * once};
  };
  const Tooth tx = tooth(grid_.dx), ty = tooth(grid_.dy);
  const int rim = grid_.line ? 0 : 1;
  for (int i = 1; i + 1 < grid_.nx; ++i)
    for (int j = rim; j + rim < grid_.ny; ++j) {
      const std::size_t k = grid_.index(i, j), n = grid_.index(i + 1, j), s = grid_.index(i - 1, j);
      const double xx = (loads_.q_x[n] - loads_.q_x[s]) / (2 * grid_.dx),
                   yx = (loads_.q_y[n] - loads_.q_y[s]) / (2 * grid_.dx);
      out.e_xx[k] += tx.normal_strain * xx;
      out.e_xy[k] += tx.shear_strain * yx;
      out.s_zz[k] += tx.s_zz * xx;
      if (grid_.line) continue;
      const double xy = (loads_.q_x[k + 1] - loads_.q_x[k - 1]) / (2 * grid_.dy),
                   yy = (loads_.q_y[k + 1] - loads_.q_y[k - 1]) / (2 * grid_.dy);
      out.e_yy[k] += ty.normal_strain * yy;
      out.e_xy[k] += ty.shear_strain * xy;
      out.s_zz[k] += ty.s_zz * yy;
    }
}

HalfSpaceMaterial Subsurface::material_at(double depth, bool below_interface) const {
  double top = 0;
  for (const HalfSpaceLayer& layer : body_.layers) {
    const double bottom = top + layer.thickness;
    if (below_interface ? depth < bottom : depth <= bottom) return layer.local(depth - top);
    top = bottom;
  }
  return body_.substrate;
}

HalfSpaceMaterial Subsurface::material_at(double y, double depth, bool below_interface) const {
  if (!section_ || !section_->in_full()) return material_at(depth, below_interface);
  const BandElement& element = section_->element_at(y, depth, below_interface);
  const bool as_in_body = element.layer > 0 && depth <= extents_[static_cast<std::size_t>(element.layer - 1)].bottom &&
                          depth >= extents_[static_cast<std::size_t>(element.layer - 1)].top;
  return as_in_body ? material_at(depth, below_interface) : element.material;
}

std::vector<int> Subsurface::layers_of_rows(double depth, bool below_interface) const {
  std::vector<int> out;
  for (int j = 0; section_ && section_->in_full() && j < grid_.ny; ++j)
    out.push_back(section_->element_at(grid_.y(j), depth, below_interface).layer);
  return out;
}

double Subsurface::bottom_of(int layer) const {
  return section_ && section_->in_full() ? section_->bottom_of(layer) : 0;
}

Sym3 Subsurface::stress(const StatePlane& plane, std::size_t k, bool below_interface) const {
  return stress_of(plane.side(below_interface).at(k), material_at(grid_.y_of(k), plane.depth, below_interface));
}

}  // namespace railstrata
