#include "bem/rows_difference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bem/wave_quadrature.hpp"
#include "core/lagrange.hpp"

namespace railstrata {

namespace {

using Matrix = Eigen::MatrixXd;

/// Of values at `nodes` what stands at each of `at`; beyond their ends that of the ends.
std::vector<LagrangeStencil> stencils_of(const std::vector<double>& nodes, const std::vector<double>& at) {
  std::vector<LagrangeStencil> out;
  for (const double t : at)
    out.push_back(
        lagrange_stencil(nodes.data(), static_cast<int>(nodes.size()), std::clamp(t, nodes.front(), nodes.back())));
  return out;
}

/// The same as shares: nodes x places.
Matrix shares_of(const std::vector<double>& nodes, const std::vector<double>& at) {
  Matrix out = Matrix::Zero(static_cast<Eigen::Index>(nodes.size()), static_cast<Eigen::Index>(at.size()));
  Eigen::Index column = 0;
  for (const LagrangeStencil& s : stencils_of(nodes, at)) {
    for (int i = 0; i < s.count; ++i) out(s.first + i, column) = s.weight[i];
    ++column;
  }
  return out;
}

/// Between the places of the stencils, of values between nodes from `first` on.
Matrix between(const std::vector<LagrangeStencil>& places, const Matrix& nodes, int first) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Matrix across = Matrix::Zero(count, nodes.cols()), out = Matrix::Zero(count, count);
  for (Eigen::Index j = 0; j < nodes.cols(); ++j)
    for (Eigen::Index i = 0; i < count; ++i) {
      const LagrangeStencil& s = places[static_cast<std::size_t>(i)];
      for (int n = 0; n < s.count; ++n) across(i, j) += s.weight[n] * nodes(s.first - first + n, j);
    }
  for (Eigen::Index j = 0; j < count; ++j) {
    const LagrangeStencil& s = places[static_cast<std::size_t>(j)];
    for (int n = 0; n < s.count; ++n) out.col(j) += s.weight[n] * across.col(s.first - first + n);
  }
  return out;
}

/// c += a b, four columns of `a` at a time; rows of zeros in `b` cost nothing.
template <class B>
void add_product(const Eigen::Ref<const Matrix>& a, const B& b, Eigen::Ref<Matrix> c) {
  const Eigen::Index rows = a.rows(), stride = a.outerStride(), whole = a.cols() / 4 * 4;
  for (Eigen::Index j = 0; j < c.cols(); ++j) {
    double* __restrict to = c.data() + j * c.outerStride();
    for (Eigen::Index k = 0; k < whole; k += 4) {
      const double* __restrict from = a.data() + k * stride;
      const double b0 = b(k, j), b1 = b(k + 1, j), b2 = b(k + 2, j), b3 = b(k + 3, j);
      if (b0 == 0 && b1 == 0 && b2 == 0 && b3 == 0) continue;
      for (Eigen::Index i = 0; i < rows; ++i)
        to[i] += b0 * from[i] + b1 * from[i + stride] + b2 * from[i + 2 * stride] + b3 * from[i + 3 * stride];
    }
    for (Eigen::Index k = whole; k < a.cols(); ++k) {
      const double* __restrict from = a.data() + k * stride;
      const double share = b(k, j);
      for (Eigen::Index i = 0; i < rows; ++i) to[i] += share * from[i];
    }
  }
}

/// to += share * of, from its element (row, column) on.
void add_block(Matrix& to, double share, const Matrix& of, Eigen::Index row, Eigen::Index column) {
  const Eigen::Index rows = to.rows();
  for (Eigen::Index j = 0; j < to.cols(); ++j) {
    double* __restrict sum = &to(0, j);
    const double* __restrict from = &of(row, column + j);
    for (Eigen::Index i = 0; i < rows; ++i) sum[i] += share * from[i];
  }
}

/// own less half_space, SectionRemainder's or at other waves, between the stations t of the contact plane.
std::vector<Matrix> difference_at(const PlacedRemainder& placed, const SectionRemainder& body,
                                  const std::vector<Matrix>& own, const std::vector<Matrix>& half_space,
                                  const std::vector<double>& t) {
  const Vec2 along{std::cos(placed.plane.angle), std::sin(placed.plane.angle)}, down{along.z, -along.y};
  const std::vector<double> at = placed.plane.along(body.stations);
  const std::vector<LagrangeStencil> places = stencils_of(at, t);
  int first = static_cast<int>(at.size()), last = 0;  // of the stations that count
  for (const LagrangeStencil& s : places) {
    first = std::min(first, s.first);
    last = std::max(last, s.first + s.count);
  }
  const auto n = static_cast<Eigen::Index>(last - first), m = static_cast<Eigen::Index>(t.size()),
             all = static_cast<Eigen::Index>(at.size());
  Eigen::Matrix3d axes;  // rows: the plane's in those of the section
  axes << 1, 0, 0, 0, along.y, along.z, 0, down.y, down.z;
  std::vector<Matrix> out(own.size(), Matrix(3 * m, 3 * m));
  for (std::size_t k = 0; k < own.size(); ++k)
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = a; b < 3; ++b) {
        Matrix turned = Matrix::Zero(n, n);
        const auto add = [&](double share, const Matrix& of, Eigen::Index c, Eigen::Index d) {
          if (share != 0) add_block(turned, share, of, c * all + first, d * all + first);
        };
        add(-1, half_space[k], a, b);
        for (Eigen::Index c = 0; c < 3; ++c)
          for (Eigen::Index d = 0; d < 3; ++d) add(axes(a, c) * axes(b, d), own[k], c, d);
        const Matrix block = between(places, turned, first);
        out[k].block(a * m, b * m, m, m) = block;
        out[k].block(b * m, a * m, m, m) = block.transpose();
      }
  return out;
}

/// Of the sections that are kept on both sides of the contact, at these waves.
std::vector<Matrix> difference_at(const PlacedRemainder& placed, const std::vector<double>& waves,
                                  const std::vector<double>& t) {
  std::vector<Matrix> sum;
  const auto add = [&](double share, const std::vector<Matrix>& own) {
    sum.resize(own.size(), Matrix::Zero(own.front().rows(), own.front().cols()));
    for (std::size_t k = 0; k < own.size(); ++k) sum[k] += share * own[k];
  };
  for (const RemainderShare& kept : placed.kept) {
    const SectionRemainder& body = *kept.remainder;
    if (body.in_full) {
      add(kept.share, at_waves(difference_at(placed, body, body.own, body.half_space, t), body.k, waves));
      continue;
    }
    const auto smooth = body.at(waves);
    add(kept.share, difference_at(placed, body, smooth->own, smooth->half_space, t));
  }
  return sum;
}

/// The wheel's SectionCompliance::by_rotation at t, downwards.
Eigen::VectorXd by_rotation_at(const PlacedRemainder& placed, const std::vector<double>& t) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(t.size()));
  for (const RemainderShare& kept : placed.kept) {
    const SectionRemainder& section = *kept.remainder;
    const std::vector<double> own = placed.plane.along(section.stations);
    out += kept.share * shares_of(own, t).transpose() *
           Eigen::Map<const Eigen::VectorXd>(section.by_rotation.data(), static_cast<Eigen::Index>(own.size()));
  }
  return out;
}

std::vector<double> rows_of(const PatchGrid& grid) {
  std::vector<double> out;
  for (int j = 0; j < grid.ny; ++j) out.push_back(grid.y(j));
  return out;
}

/// Wave number of both, 1/m: that of a rail on springs is far below the wheel's.
double lowest_of(const PlacedRemainder& rail, const PlacedRemainder& wheel) {
  return std::min(rail.kept.front().remainder->k.front(), wheel.kept.front().remainder->k.front());
}

/// A kernel's own at the middle station; x couples with the others by waves that are odd in k.
Eigen::Matrix3d in_the_middle(const Matrix& kernel) {
  const Eigen::Index n = kernel.rows() / 3;
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b)
      if ((a == 0) == (b == 0)) own(a, b) = kernel(a * n + n / 2, b * n + n / 2);
  return own;
}

/// Of waves, real parts on the left and imaginary ones on the right: Q = q_x/i, u_x = i U.
template <class Kernel>
void add_waves(const Kernel& kernel, Eigen::Index x_in, Eigen::Index x_out, Matrix& force, Matrix& u) {
  using TwoColumns = Eigen::Map<Matrix, 0, Eigen::OuterStride<>>;
  const Eigen::Index count = u.cols() / 2;
  const auto turn = [count](Matrix& of, Eigen::Index rows, double sign) {
    Matrix real = of.topLeftCorner(rows, count);
    of.topLeftCorner(rows, count) = sign * of.topRightCorner(rows, count);
    of.topRightCorner(rows, count) = -sign * real;
  };
  turn(force, x_in, 1);
  for (Eigen::Index q = 0; q < count; ++q)
    add_product(kernel(q), TwoColumns(&force(0, q), force.rows(), 2, Eigen::OuterStride<>(count * force.rows())),
                TwoColumns(&u(0, q), u.rows(), 2, Eigen::OuterStride<>(count * u.rows())));
  turn(u, x_out, -1);
}

}  // namespace

RowsDifference::Part RowsDifference::part_of(const PlacedRemainder& placed, const PatchGrid& grid, double lowest) {
  constexpr double kStation = 3e-3;  // m
  const SectionRemainder& body = *placed.kept.front().remainder;
  const std::vector<double> rows = rows_of(grid);
  std::vector<double> stations;
  const int half = std::max(2, static_cast<int>(std::ceil(0.5 * grid.ny * grid.dy / kStation)));
  for (int m = -half; m <= half; ++m) stations.push_back(m * kStation);
  if (body.in_full) stations = rows;
  Part out;
  out.in_full = body.in_full;
  out.shares = shares_of(stations, rows);
  out.of_rows = out.shares.transpose();
  const WaveQuadrature waves(lowest, body.k.back(), (grid.nx + 1) * grid.dx);
  Kernel kernel = difference_at(placed, waves.k, stations);
  const auto count = static_cast<Eigen::Index>(waves.k.size());
  const auto smooth = std::upper_bound(waves.k.begin(), waves.k.end(), SectionRemainder::kSmoothTo) - waves.k.begin();
  Eigen::Matrix3d local = Eigen::Matrix3d::Zero();
  if (body.in_full) local = in_the_middle(kernel[static_cast<std::size_t>(smooth - 1)]);
  out.along.resize(grid.nx + 1, 2 * count);
  for (Eigen::Index q = 0; q < count; ++q) {
    Matrix& at = kernel[static_cast<std::size_t>(q)];
    const double k = waves.k[static_cast<std::size_t>(q)], half_cell = 0.5 * k * grid.dx,
                 weight =
                     waves.weight[static_cast<std::size_t>(q)] * std::sin(half_cell) / (half_cell * std::numbers::pi);
    if (q < smooth) out.rigid += weight * (in_the_middle(at) - local);
    at *= weight;
    for (int i = 0; i <= grid.nx; ++i) {
      out.along(i, q) = std::cos(k * i * grid.dx);
      out.along(i, count + q) = -std::sin(k * i * grid.dx);
    }
  }
  out.kernel = std::make_shared<const Kernel>(std::move(kernel));
  return out;
}

RowsDifference::RowsDifference(const PlacedRemainder& rail, const PlacedRemainder& wheel, const PatchGrid& grid)
    : nx_(grid.nx),
      ny_(grid.ny),
      cell_area_(grid.cell_area()),
      pair_{part_of(rail, grid, lowest_of(rail, wheel))},
      wheel_(part_of(wheel, grid, lowest_of(rail, wheel))),
      by_rotation_(by_rotation_at(wheel, rows_of(grid))),
      rigid_(pair_[0].rigid + wheel_.rigid) {
  for (const RemainderShare& kept : rail.kept) stretch_by_load_ += kept.share * kept.remainder->stretch_by_load;
  if (rail.kept.front().remainder->in_full != wheel.kept.front().remainder->in_full) {
    pair_.push_back(wheel_);
    return;
  }
  auto both = std::make_shared<Kernel>(*pair_[0].kernel);
  for (std::size_t q = 0; q < both->size(); ++q) (*both)[q] += (*wheel_.kernel)[q];
  pair_[0].kernel = std::move(both);
}

void RowsDifference::keep_stations(Part& part) {
  const Eigen::Index stations = part.shares.rows();
  Eigen::Index first = 0, last = stations - 1;
  while (part.shares.row(first).isZero(0)) ++first;
  while (part.shares.row(last).isZero(0)) --last;
  const Eigen::Index n = last - first + 1;
  Kernel kernel(part.kernel->size(), Matrix(3 * n, 3 * n));
  for (std::size_t o = 0; o < kernel.size(); ++o)
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = 0; b < 3; ++b)
        kernel[o].block(a * n, b * n, n, n) = (*part.kernel)[o].block(a * stations + first, b * stations + first, n, n);
  part.kernel = std::make_shared<const Kernel>(std::move(kernel));
  part.shares = Matrix(part.shares.middleRows(first, n));
}

std::shared_ptr<const RowsDifference> RowsDifference::part(int first_y, int nx, int ny) const {
  auto out = std::make_shared<RowsDifference>(*this);
  out->nx_ = nx;
  out->ny_ = ny;
  const auto cut = [&](Part& part) {
    part.shares = Matrix(part.shares.middleCols(first_y, ny));
    if (!part.in_full) keep_stations(part);
    part.of_rows = part.shares.transpose();
    part.along = Matrix(part.along.topRows(nx + 1));
  };
  std::for_each(out->pair_.begin(), out->pair_.end(), cut);
  cut(out->wheel_);
  return out;
}

void RowsDifference::add(const In& in, const Out& out, int rows) const {
  for (const Part& part : pair_) add(part, in, out, rows);
  Eigen::Vector3d load = Eigen::Vector3d::Zero();
  for (std::size_t a = 0; a < 3; ++a)
    if (in[a])
      load[static_cast<Eigen::Index>(a)] = cell_area_ * Eigen::Map<const Eigen::VectorXd>(in[a], ny_ * nx_).sum();
  const Eigen::Vector3d whole = rigid_ * load;
  for (std::size_t a = 0; a < 3; ++a)
    if (out[a]) Eigen::Map<Eigen::VectorXd>(out[a], ny_ * rows).array() -= whole[static_cast<Eigen::Index>(a)];
}

void RowsDifference::add(const Part& part, const In& in, const Out& out, int rows) const {
  const Eigen::Index n = part.shares.rows(), functions = part.along.cols();
  const bool along_surface = in[0] || in[1], moves_along = out[0] || out[1];  // the normal direction stands alone
  const Eigen::Index from = along_surface ? 0 : 2 * n, inputs = along_surface ? 2 * n : n, to = moves_along ? 0 : 2 * n,
                     outputs = moves_along ? 2 * n : n;
  Matrix force = Matrix::Zero(inputs, functions), u = Matrix::Zero(outputs, functions);
  for (std::size_t a = 0; a < 3; ++a) {
    if (!in[a]) continue;
    Matrix of_cells = Matrix::Zero(n, nx_);
    add_product(part.shares, Eigen::Map<const Matrix>(in[a], ny_, nx_), of_cells);
    of_cells *= cell_area_;
    add_product(of_cells, part.along.topRows(nx_), force.middleRows(static_cast<Eigen::Index>(a) * n - from, n));
  }
  const auto kernel = [&](Eigen::Index i) {
    return (*part.kernel)[static_cast<std::size_t>(i)].block(to, from, outputs, inputs);
  };
  add_waves(kernel, along_surface ? n : 0, moves_along ? n : 0, force, u);
  for (std::size_t a = 0; a < 3; ++a) {
    if (!out[a]) continue;
    Matrix of_cells = Matrix::Zero(n, rows);
    add_product(u.middleRows(static_cast<Eigen::Index>(a) * n - to, n), part.along.topRows(rows).transpose(), of_cells);
    add_product(part.of_rows, of_cells, Eigen::Map<Matrix>(out[a], ny_, rows));
  }
}

}  // namespace railstrata
