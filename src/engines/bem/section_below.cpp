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
constexpr int kComponents = 6;
constexpr std::array<Plane StatePlane::*, kComponents> kOfState{
    &StatePlane::e_xx, &StatePlane::e_yy, &StatePlane::e_xy, &StatePlane::s_xz, &StatePlane::s_yz, &StatePlane::s_zz};
constexpr int kFirstTraction = 3;
constexpr bool is_imaginary(int component) { return component == 2 || component == 3; }

/// Places along the plane.
std::vector<double> along_plane(const std::vector<Vec2>& points, const LoadedSection& section) {
  const Vec2 along{std::cos(section.angle), std::sin(section.angle)};
  std::vector<double> out;
  for (const Vec2 p : points) out.push_back(dot(p - section.contact, along));
  return out;
}

LagrangeStencil within(const std::vector<double>& at, double t, int most) {
  return lagrange_stencil(at.data(), static_cast<int>(at.size()), std::clamp(t, at.front(), at.back()), most);
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

/// Rows of elements and their weights at a depth: linear between their middles, below the last one as there.
struct RowsAt {
  int first = 0;
  std::array<double, 2> strain{1, 0}, traction{1, 0};
};

/// Tractions on the surface are what acts there, whatever the body: their difference is 0.
RowsAt rows_at(const std::vector<double>& depth, double z) {
  const int last = static_cast<int>(depth.size()) - 1;
  if (last == 0) return {};
  const int above = static_cast<int>(std::upper_bound(depth.begin(), depth.end(), z) - depth.begin());
  RowsAt out;
  out.first = std::clamp(above - 1, 0, last - 1);
  const double from = depth[out.first], share = std::min(1.0, (z - from) / (depth[out.first + 1] - from));
  out.strain = out.traction = {1 - share, share};
  if (z < depth.front()) out.traction = {z / depth.front(), 0};
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
  part.y = along_plane(of.columns, *section_);
  part.depth = of.depth;
  const std::vector<double> stations = along_plane(of.stations, *section_);
  const auto count = static_cast<Eigen::Index>(k_.size());
  part.real = part.imag = Matrix::Zero(of.at.front().rows(), count);
  std::vector<double> log;
  for (const double k : of.k) log.push_back(std::log(k));
  for (Eigen::Index q = 0; q < count; ++q) {
    const double k = k_[static_cast<std::size_t>(q)];
    const Matrix force = kept.share * forces_of_wave(*section_, stations, k);
    const LagrangeStencil s =
        lagrange_stencil(log.data(), static_cast<int>(log.size()), std::log(k), k < of.k.front() ? 2 : 4);
    for (int i = 0; i < s.count; ++i) {
      const Matrix state = s.weight[i] * (of.at[static_cast<std::size_t>(s.first + i)] * force);
      part.real.col(q) += state.col(0);
      part.imag.col(q) += state.col(1);
    }
  }
  parts_.push_back(std::move(part));
}

void SectionBelow::add(StatePlane& plane) const {
  const auto waves = static_cast<Eigen::Index>(k_.size());
  for (const Part& part : parts_) {
    const RowsAt rows = rows_at(part.depth, plane.depth);
    const auto columns = static_cast<Eigen::Index>(part.y.size());
    for (int component = 0; component < kComponents; ++component) {
      const std::array<double, 2>& weight = component < kFirstTraction ? rows.strain : rows.traction;
      Matrix real = Matrix::Zero(grid_.ny, waves), imag = real;
      for (int j = 0; j < grid_.ny; ++j) {
        const LagrangeStencil s = within(part.y, grid_.y(j), 4);
        for (int i = 0; i < s.count; ++i)
          for (int r = 0; r < 2; ++r) {
            if (weight[static_cast<std::size_t>(r)] == 0) continue;
            const Eigen::Index row = kComponents * ((rows.first + r) * columns + s.first + i) + component;
            const double share = s.weight[i] * weight[static_cast<std::size_t>(r)];
            real.row(j) += share * part.real.row(row);
            imag.row(j) += share * part.imag.row(row);
          }
      }
      // Re (c e^{ikx}), or of i times that.
      const Matrix sum =
          is_imaginary(component) ? Matrix(-(real * sin_ + imag * cos_)) : Matrix(real * cos_ - imag * sin_);
      Eigen::Map<Matrix>((plane.*kOfState[static_cast<std::size_t>(component)]).data(), grid_.ny, grid_.nx) += sum;
    }
  }
}

}  // namespace railstrata
