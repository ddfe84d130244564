#include "bem/rows_difference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/lagrange.hpp"
#include "crack/gauss.hpp"

namespace railstrata {

namespace {

using Matrix = Eigen::MatrixXd;
constexpr double kStationsOfRows = 2e-3;  // m

/// What stands at `at` as shares of values at `nodes`; beyond their ends those of the ends.
Matrix shares_of(const std::vector<double>& nodes, const std::vector<double>& at) {
  Matrix out = Matrix::Zero(static_cast<Eigen::Index>(nodes.size()), static_cast<Eigen::Index>(at.size()));
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double t = std::clamp(at[j], nodes.front(), nodes.back());
    const LagrangeStencil s = lagrange_stencil(nodes.data(), static_cast<int>(nodes.size()), t);
    for (int i = 0; i < s.count; ++i) out(s.first + i, static_cast<Eigen::Index>(j)) = s.weight[i];
  }
  return out;
}

/// Wave numbers and weights of ∫ dk over 0 … highest for waves over lengths up to `reach`.
struct WaveQuadrature {
  std::vector<double> k, weight;
  void add_panel(double from, double to, bool in_logarithm) {
    for (const GaussPoint& g : kGauss8) {
      const double at = in_logarithm ? from * std::pow(to / from, g.node) : from + g.node * (to - from);
      k.push_back(at);
      weight.push_back(g.weight * (in_logarithm ? at * std::log(to / from) : to - from));
    }
  }
};
WaveQuadrature wave_quadrature(double lowest, double highest, double reach) {
  constexpr double kRadians = 8;  // of a wave in a panel of eight points
  WaveQuadrature out;
  const double even = std::min(kRadians / reach, highest);
  // below the lowest D is linear in ln k: its integral is the value at lowest/e
  out.k.push_back(lowest / std::numbers::e);
  out.weight.push_back(lowest);
  const int low = std::max(1, static_cast<int>(std::ceil(std::log(even / lowest) / 4)));
  for (int i = 0; i < low; ++i)
    out.add_panel(lowest * std::pow(even / lowest, 1.0 * i / low), lowest * std::pow(even / lowest, (i + 1.0) / low),
                  true);
  const int panels = static_cast<int>(std::ceil((highest - even) / even));
  for (int i = 0; i < panels; ++i)
    out.add_panel(even + (highest - even) * i / panels, even + (highest - even) * (i + 1) / panels, false);
  return out;
}

/// D of a body at its wave numbers, between the stations t of the contact plane.
std::vector<Matrix> difference_at(const PlacedRemainder& placed, const SectionRemainder& body,
                                  const std::vector<double>& t) {
  const SectionCompliance& section = body.section;
  const Vec2 along{std::cos(placed.angle), std::sin(placed.angle)}, down{along.z, -along.y};
  std::vector<double> own;
  for (const Vec2 p : section.stations) own.push_back(dot(p - placed.contact, along));
  const Matrix shares = shares_of(own, t);
  Eigen::Index first = 0, last = shares.rows() - 1;  // of the stations that count
  while (shares.row(first).isZero(0)) ++first;
  while (shares.row(last).isZero(0)) --last;
  const Eigen::Index n = last - first + 1, m = shares.cols();
  const Matrix near = shares.middleRows(first, n);
  Eigen::Matrix3d axes;  // rows: the plane's in those of the section
  axes << 1, 0, 0, 0, along.y, along.z, 0, down.y, down.z;
  std::vector<Matrix> out;
  Matrix turned(3 * n, 3 * n);
  for (std::size_t k = 0; k < section.k.size(); ++k) {
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const Eigen::Index row = 3 * (first + i), column = 3 * (first + j);
        const Eigen::Matrix3d d = axes * section.at[k].block<3, 3>(row, column) * axes.transpose() -
                                  body.half_space[k].block<3, 3>(row, column);
        for (Eigen::Index a = 0; a < 3; ++a)
          for (Eigen::Index b = 0; b < 3; ++b) turned(a * n + i, b * n + j) = d(a, b);
      }
    Matrix& at = out.emplace_back(3 * m, 3 * m);
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = 0; b < 3; ++b)
        at.block(a * m, b * m, m, m) = near.transpose() * turned.block(a * n, b * n, n, n) * near;
  }
  if (body.in_full) return out;
  Matrix last_k = out.back();  // but of the coupling of x with the others, which is odd in k
  last_k.topRightCorner(m, 2 * m).setZero();
  last_k.bottomLeftCorner(2 * m, m).setZero();
  for (Matrix& rest : out) rest -= last_k;
  return out;
}

/// Of the sections that are kept on both sides of the contact.
std::vector<Matrix> difference_at(const PlacedRemainder& placed, const std::vector<double>& t) {
  std::vector<Matrix> sum;
  for (const RemainderShare& kept : placed.kept) {
    const std::vector<Matrix> own = difference_at(placed, *kept.remainder, t);
    sum.resize(own.size(), Matrix::Zero(own.front().rows(), own.front().cols()));
    for (std::size_t k = 0; k < own.size(); ++k) sum[k] += kept.share * own[k];
  }
  return sum;
}

/// The wheel's SectionCompliance::by_rotation at t, downwards.
Eigen::VectorXd by_rotation_at(const PlacedRemainder& placed, const std::vector<double>& t) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(t.size()));
  const Vec2 along{std::cos(placed.angle), std::sin(placed.angle)};
  for (const RemainderShare& kept : placed.kept) {
    const SectionCompliance& section = kept.remainder->section;
    std::vector<double> own;
    for (const Vec2 p : section.stations) own.push_back(dot(p - placed.contact, along));
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

/// At other wave numbers, linear in ln k below the first.
std::vector<Matrix> at_waves(const std::vector<Matrix>& values, const std::vector<double>& k,
                             const std::vector<double>& wanted) {
  std::vector<double> log;
  for (const double at : k) log.push_back(std::log(at));
  std::vector<Matrix> out;
  for (const double at : wanted) {
    const LagrangeStencil s =
        lagrange_stencil(log.data(), static_cast<int>(log.size()), std::log(at), at < k.front() ? 2 : 4);
    Matrix sum = Matrix::Zero(values.front().rows(), values.front().cols());
    for (int i = 0; i < s.count; ++i) sum += s.weight[i] * values[static_cast<std::size_t>(s.first + i)];
    out.push_back(std::move(sum));
  }
  return out;
}

}  // namespace

RowsDifference::Part RowsDifference::part_of(const PlacedRemainder& placed, const PatchGrid& grid) {
  const SectionRemainder& body = *placed.kept.front().remainder;
  std::vector<double> stations;
  const std::vector<double> rows = rows_of(grid);
  const int half = std::max(2, static_cast<int>(std::ceil(0.5 * grid.ny * grid.dy / kStationsOfRows)));
  for (int m = -half; m <= half; ++m) stations.push_back(m * kStationsOfRows);
  if (body.in_full) stations = rows;
  Part out;
  out.shares = shares_of(stations, rows);
  const std::vector<double>& known = body.section.k;
  const WaveQuadrature waves = wave_quadrature(known.front(), known.back(), (grid.nx + 1) * grid.dx);
  out.kernel = std::make_shared<const Kernel>(at_waves(difference_at(placed, stations), known, waves.k));
  const auto count = static_cast<Eigen::Index>(waves.k.size());
  out.weight.resize(count);
  out.cosines.resize(count, grid.nx + 1);
  out.sines.resize(count, grid.nx + 1);
  for (Eigen::Index q = 0; q < count; ++q) {
    const double k = waves.k[static_cast<std::size_t>(q)], half_cell = 0.5 * k * grid.dx;
    out.weight[q] = waves.weight[static_cast<std::size_t>(q)] * std::sin(half_cell) / (half_cell * std::numbers::pi);
    for (int i = 0; i <= grid.nx; ++i) {
      out.cosines(q, i) = std::cos(k * i * grid.dx);
      out.sines(q, i) = std::sin(k * i * grid.dx);
    }
  }
  const auto smooth = std::upper_bound(waves.k.begin(), waves.k.end(), SectionRemainder::kSmoothTo) - waves.k.begin();
  const auto at_middle = [&](Eigen::Index q) {
    const Matrix& kernel = (*out.kernel)[static_cast<std::size_t>(q)];
    const Eigen::Index n = out.shares.rows();
    Eigen::Matrix3d own = Eigen::Matrix3d::Zero();  // x couples with the others by waves that are odd in k
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = 0; b < 3; ++b)
        if ((a == 0) == (b == 0)) own(a, b) = kernel(a * n + n / 2, b * n + n / 2);
    return own;
  };
  const Eigen::Matrix3d local = body.in_full ? at_middle(smooth - 1) : Eigen::Matrix3d::Zero();
  for (Eigen::Index q = 0; q < smooth; ++q) out.rigid += out.weight[q] * (at_middle(q) - local);
  return out;
}

RowsDifference::RowsDifference(const PlacedRemainder& rail, const PlacedRemainder& wheel, const PatchGrid& grid)
    : nx_(grid.nx),
      ny_(grid.ny),
      cell_area_(grid.cell_area()),
      pair_{part_of(rail, grid)},
      wheel_(part_of(wheel, grid)),
      by_rotation_(by_rotation_at(wheel, rows_of(grid))),
      rigid_(pair_[0].rigid + wheel_.rigid) {
  if (rail.kept.front().remainder->in_full != wheel.kept.front().remainder->in_full) {
    pair_.push_back(wheel_);
    return;
  }
  auto both = std::make_shared<Kernel>(*pair_[0].kernel);
  for (std::size_t q = 0; q < both->size(); ++q) (*both)[q] += (*wheel_.kernel)[q];
  pair_[0].kernel = std::move(both);
}

std::shared_ptr<const RowsDifference> RowsDifference::part(int first_y, int nx, int ny) const {
  auto out = std::make_shared<RowsDifference>(*this);
  out->nx_ = nx;
  out->ny_ = ny;
  const auto cut = [&](Part& part) {
    part.shares = Matrix(part.shares.middleCols(first_y, ny));
    part.cosines = Matrix(part.cosines.leftCols(nx + 1));
    part.sines = Matrix(part.sines.leftCols(nx + 1));
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
  const auto& [shares, cosines, sines, weight, kernel, rigid] = part;
  const Eigen::Index n = shares.rows(), count = weight.size();
  std::array<Matrix, 3> real, imaginary, u_real, u_imaginary;
  for (std::size_t a = 0; a < 3; ++a) {
    if (in[a]) {
      const Matrix force = cell_area_ * shares * Eigen::Map<const Matrix>(in[a], ny_, nx_);
      real[a] = force * cosines.leftCols(nx_).transpose();
      imaginary[a] = -force * sines.leftCols(nx_).transpose();
      if (a == 0) {  // Q = q_x/i
        std::swap(real[a], imaginary[a]);
        imaginary[a] *= -1;
      }
    }
    if (out[a]) {
      u_real[a] = Matrix::Zero(n, count);
      u_imaginary[a] = Matrix::Zero(n, count);
    }
  }
  for (Eigen::Index q = 0; q < count; ++q)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; out[a] && b < 3; ++b) {
        if (!in[b]) continue;
        const auto block = (*kernel)[static_cast<std::size_t>(q)].block(static_cast<Eigen::Index>(a) * n,
                                                                        static_cast<Eigen::Index>(b) * n, n, n);
        u_real[a].col(q) += weight[q] * (block * real[b].col(q));
        u_imaginary[a].col(q) += weight[q] * (block * imaginary[b].col(q));
      }
  for (std::size_t a = 0; a < 3; ++a) {
    if (!out[a]) continue;
    if (a == 0) {  // u_x = i U
      std::swap(u_real[a], u_imaginary[a]);
      u_real[a] *= -1;
    }
    const Matrix u = u_real[a] * cosines.leftCols(rows) - u_imaginary[a] * sines.leftCols(rows);
    Eigen::Map<Matrix>(out[a], ny_, rows) += shares.transpose() * u;
  }
}

}  // namespace railstrata
