#include "bem/section_below.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "bem/wave_quadrature.hpp"
#include "core/lagrange.hpp"

namespace railstrata {

namespace {

using Matrix = Eigen::MatrixXd;
constexpr int kComponents = SectionInterior::kComponents;
constexpr std::array<Plane StatePlane::*, kComponents> kOfState{
    &StatePlane::e_xx, &StatePlane::e_yy, &StatePlane::e_xy, &StatePlane::s_xz, &StatePlane::s_yz, &StatePlane::s_zz};
constexpr bool is_imaginary(int component) { return component == 2 || component == 3; }

LagrangeStencil within(const std::vector<double>& at, double t, int most) {
  return lagrange_stencil(at.data(), static_cast<int>(at.size()), std::clamp(t, at.front(), at.back()), most);
}

std::size_t column_at(const std::vector<double>& columns, double y) {
  return static_cast<std::size_t>(within(columns, y, 1).first);
}

/// Forces on the stations of a wave e^{-ikx}: real parts in the first column, imaginary ones in the second; of x over
/// i.
Matrix forces_of_wave(const LoadedSection& section, const std::vector<double>& stations, double k) {
  const PatchGrid& g = section.grid;
  Matrix out = Matrix::Zero(3 * static_cast<Eigen::Index>(stations.size()), 2);
  const std::array<const Plane*, 3> planes{&section.loads.q_x, &section.loads.q_y, &section.loads.p};
  for (int j = 0; j < g.ny; ++j) {
    std::array<double, 3> real{}, imag{};
    for (int i = 0; i < g.nx; ++i) {
      const double c = std::cos(k * g.x(i)), s = std::sin(k * g.x(i));
      for (std::size_t a = 0; a < 3; ++a) {
        const double force = g.cell_area() * (*planes[a])[g.index(i, j)];
        real[a] += force * c;
        imag[a] -= force * s;
      }
    }
    std::swap(real[0], imag[0]);
    imag[0] = -imag[0];
    const LagrangeStencil s = within(stations, g.y(j), 4);
    for (int i = 0; i < s.count; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        const auto row = static_cast<Eigen::Index>(3 * static_cast<std::size_t>(s.first + i) + a);
        out(row, 0) += s.weight[i] * real[a];
        out(row, 1) += s.weight[i] * imag[a];
      }
  }
  return out;
}

/// Up to three rows of elements and their weights at a depth.
struct RowsAt {
  LagrangeStencil rows;
  double strain = 1, traction = 1;  // of the sums
};

/// The row that holds a depth in a column; of two the upper one, or the lower one.
int row_at(const SectionInterior& of, std::size_t column, double z, bool lower) {
  const int columns = static_cast<int>(of.columns.size()), rows = static_cast<int>(of.elements.size()) / columns;
  int r = 0;
  const auto bottom = [&](int row) { return of.elements[static_cast<std::size_t>(row * columns) + column].bottom; };
  const auto margin = [&](int row) { return 0.02 * (bottom(row) - (row > 0 ? bottom(row - 1) : 0.0)); };
  while (r + 1 < rows && z > bottom(r) + (lower ? -margin(r) : margin(r))) ++r;
  return r;
}

/// A parabola through the middles of rows of one layer, also beyond them; below the last row falling as stresses below
/// a load do. Tractions on the surface are what acts there, whatever the body: their difference is 0.
RowsAt rows_at(const SectionInterior& of, std::size_t column, double z) {
  const int columns = static_cast<int>(of.columns.size()), count = static_cast<int>(of.elements.size()) / columns;
  const auto element = [&](int row) { return of.elements[static_cast<std::size_t>(row * columns) + column]; };
  const int own = row_at(of, column, z, false);
  const auto alike = [&](int row) { return row >= 0 && row < count && element(row).layer == element(own).layer; };
  int first = own, last = own;
  while (alike(first - 1)) --first;
  while (alike(last + 1)) ++last;
  std::vector<double> depth;
  for (int row = first; row <= last; ++row) depth.push_back(element(row).depth);
  const double lowest = element(count - 1).depth, within_band = std::min(z, lowest);
  RowsAt out{lagrange_stencil(depth.data(), static_cast<int>(depth.size()), within_band, 3)};
  out.rows.first += first;
  if (z > lowest) out.strain = out.traction = std::pow(lowest / z, 2);
  if (z < element(0).depth) out.traction = z / element(0).depth;
  return out;
}

}  // namespace

SectionBelow::SectionBelow(std::shared_ptr<const LoadedSection> section, const PatchGrid& grid)
    : section_(std::move(section)), grid_(grid) {
  const PatchGrid& loaded = section_->grid;
  const SectionInterior& first = *section_->kept.front().difference;
  const double reach =
      std::max(loaded.x(loaded.nx - 1), grid.x(grid.nx - 1)) - std::min(loaded.x0, grid.x0) + loaded.dx;
  const WaveQuadrature waves(first.k.front(), first.k.back(), reach);
  k_ = waves.k;
  for (const InteriorShare& kept : section_->kept) add_part(kept);
  const auto count = static_cast<Eigen::Index>(k_.size());
  cos_.resize(count, grid.nx);
  sin_.resize(count, grid.nx);
  for (Eigen::Index q = 0; q < count; ++q) {
    const double k = k_[static_cast<std::size_t>(q)], half = 0.5 * k * loaded.dx,
                 weight = waves.weight[static_cast<std::size_t>(q)] * std::sin(half) / (half * std::numbers::pi);
    for (int i = 0; i < grid.nx; ++i) {
      cos_(q, i) = weight * std::cos(k * grid.x(i));
      sin_(q, i) = weight * std::sin(k * grid.x(i));
    }
  }
}

std::unique_ptr<SectionBelow> SectionBelow::on(const PatchGrid& grid) const {
  return std::make_unique<SectionBelow>(section_, grid);
}

void SectionBelow::add_part(const InteriorShare& kept) {
  const SectionInterior& of = *kept.difference;
  Part part;
  part.of = &of;
  part.y = section_->plane.along(of.columns);
  const std::vector<double> stations = section_->plane.along(of.stations);
  const auto count = static_cast<Eigen::Index>(k_.size());
  std::vector<double> log;
  for (const double k : of.k) log.push_back(std::log(k));
  std::vector<LagrangeStencil> at;
  Matrix force(of.at.front().cols(), 2 * count);
  for (Eigen::Index q = 0; q < count; ++q) {
    const double k = k_[static_cast<std::size_t>(q)];
    at.push_back(lagrange_stencil(log.data(), static_cast<int>(log.size()), std::log(k), k < of.k.front() ? 2 : 4));
    force.middleCols(2 * q, 2) = kept.share * forces_of_wave(*section_, stations, k);
  }
  part.real = part.imag = Matrix::Zero(of.at.front().rows(), count);
  for (int i = 0; i < static_cast<int>(of.k.size()); ++i) {
    const auto holds = [i](const LagrangeStencil& s) { return i >= s.first && i < s.first + s.count; };
    const Eigen::Index from = std::find_if(at.begin(), at.end(), holds) - at.begin(),
                       to = std::find_if(at.rbegin(), at.rend(), holds).base() - at.begin();
    const Matrix states =
        of.at[static_cast<std::size_t>(i)] * force.middleCols(2 * from, 2 * std::max(to - from, Eigen::Index{0}));
    for (Eigen::Index q = from; q < to; ++q) {
      const LagrangeStencil& s = at[static_cast<std::size_t>(q)];
      const double weight = s.weight[static_cast<std::size_t>(i - s.first)];
      part.real.col(q) += weight * states.col(2 * (q - from));
      part.imag.col(q) += weight * states.col(2 * (q - from) + 1);
    }
  }
  parts_.push_back(std::move(part));
}

/// In full those of one material.
LagrangeStencil SectionBelow::columns_at(const Part& part, double y, double depth) const {
  if (!in_full()) return within(part.y, y, 4);
  const LagrangeStencil two = within(part.y, y, 2);
  const auto first = static_cast<std::size_t>(two.first);
  const bool alike = element_at(part.y[first], depth, false).layer == element_at(part.y[first + 1], depth, false).layer;
  return alike ? two : within(part.y, y, 1);
}

void SectionBelow::add(StatePlane& plane) const {
  const auto waves = static_cast<Eigen::Index>(k_.size());
  for (int j = 0; in_full() && j < grid_.ny; ++j) {
    const double scale =
        section_->kept.front().difference->block_young / element_at(grid_.y(j), plane.depth, false).material.young;
    for (int component = 0; component < SectionInterior::kStrains; ++component)
      for (int i = 0; i < grid_.nx; ++i)
        (plane.*kOfState[static_cast<std::size_t>(component)])[grid_.index(i, j)] *= scale;
  }
  for (const Part& part : parts_) {
    std::vector<RowsAt> rows;
    for (std::size_t c = 0; c < part.y.size(); ++c) rows.push_back(rows_at(*part.of, c, plane.depth));
    for (int component = 0; component < kComponents; ++component) {
      Matrix real = Matrix::Zero(grid_.ny, waves), imag = real;
      for (int j = 0; j < grid_.ny; ++j) {
        const LagrangeStencil s = columns_at(part, grid_.y(j), plane.depth);
        for (int i = 0; i < s.count; ++i) {
          const auto column = static_cast<std::size_t>(s.first + i);
          const RowsAt& at = rows[column];
          for (int r = 0; r < at.rows.count; ++r) {
            const double share =
                s.weight[i] * at.rows.weight[r] * (component < SectionInterior::kStrains ? at.strain : at.traction);
            const auto element =
                static_cast<Eigen::Index>(static_cast<std::size_t>(at.rows.first + r) * part.y.size() + column);
            real.row(j) += share * part.real.row(kComponents * element + component);
            imag.row(j) += share * part.imag.row(kComponents * element + component);
          }
        }
      }
      // Re (c e^{ikx}), or of i times that.
      const Matrix sum =
          is_imaginary(component) ? Matrix(-(real * sin_ + imag * cos_)) : Matrix(real * cos_ - imag * sin_);
      Eigen::Map<Matrix>((plane.*kOfState[static_cast<std::size_t>(component)]).data(), grid_.ny, grid_.nx) += sum;
    }
  }
}

const BandElement& SectionBelow::element_at(double y, double depth, bool below_interface) const {
  const Part& part = parts_.front();
  const std::size_t column = column_at(part.y, y);
  const auto row = static_cast<std::size_t>(row_at(*part.of, column, depth, below_interface));
  return part.of->elements[row * part.y.size() + column];
}

double SectionBelow::bottom_of(int layer) const {
  double out = 0;
  for (const BandElement& e : parts_.front().of->elements)
    if (e.layer == layer) out = std::max(out, e.bottom);
  return out;
}

}  // namespace railstrata
