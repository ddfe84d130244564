#pragma once
// The scratch memory of a tile: gather of displacements into it and scatter of forces out of it.
#include "body/tiling.hpp"
#include "core/array.hpp"
#include "core/rotation.hpp"
#include "core/sweep_kind.hpp"
#include "core/vectorize.hpp"

namespace railstrata {

/// A node that is being worked on has twelve rows: displacements at a station and the next, sum and difference by
/// component; forces in the same form, s - d in front of the element and s + d behind it.
template <class Real>
struct ScratchRows {
  static constexpr int kSum = 0, kDifference = 3, kForces = 6, kRows = 12;
  static constexpr std::size_t kNode = static_cast<std::size_t>(kRows) * kTile;
  std::vector<Real, CacheLineAllocator<Real>> rows;
  alignas(64) Real zero[(kRows - kForces) * kTile] = {};  ///< forces on a node before its first element
  void fit(int slots) {
    const std::size_t wanted = static_cast<std::size_t>(slots) * kNode;
    if (rows.size() < wanted) rows.resize(wanted);
  }
};

/// Rotation of a tile's elements into the carried frame, by station.
struct CarriedRows {
  const double *cosine, *sine;
};

/// Gather: displacements of a node at stations 0 … count as sums and differences over the elements between them, in the
/// carried frame.
template <SweepKind kind, class Real>
void gather_displacements(const double* const (&line)[3], CarriedRows frame, int count, Real* rows) {
  const double *x = line[0], *y = line[1], *z = line[2];
  Real *sx = rows, *sy = sx + kTile, *sz = sy + kTile;
  Real *dx = sz + kTile, *dy = dx + kTile, *dz = dy + kTile;
  RAILSTRATA_INDEPENDENT
  for (int j = 0; j < count; ++j) {
    const double a = x[j + 1] + x[j], b = z[j + 1] + z[j], da = x[j + 1] - x[j], db = z[j + 1] - z[j];
    sy[j] = static_cast<Real>(y[j + 1] + y[j]);
    dy[j] = static_cast<Real>(y[j + 1] - y[j]);
    if constexpr (kind == SweepKind::revolve) {
      const Rotation<double> carried{frame.cosine[j], frame.sine[j]};
      const PlaneVector<double> both = carried.forward(a, b), apart = carried.forward(da, db);
      sx[j] = static_cast<Real>(both.x);
      sz[j] = static_cast<Real>(both.z);
      dx[j] = static_cast<Real>(apart.x);
      dz[j] = static_cast<Real>(apart.z);
    } else {
      sx[j] = static_cast<Real>(a);
      sz[j] = static_cast<Real>(b);
      dx[j] = static_cast<Real>(da);
      dz[j] = static_cast<Real>(db);
    }
  }
}

/// Scatter: forces of the elements in front of and behind the stations 0 < j < count, model frame:
/// complete[i * kTile + j]; those at station 0 from the element in front of it, at station `count` from the one behind.
template <SweepKind kind, class Real>
void scatter_forces(const Real* rows, CarriedRows frame, int count, double* complete, double* first, double* end) {
  const Real *sx = rows, *sy = sx + kTile, *sz = sy + kTile;
  const Real *dx = sz + kTile, *dy = dx + kTile, *dz = dy + kTile;
  auto in_model = [&](int j, Real x, Real y, Real z, double& fx, double& fy, double& fz) {
    const double a = x, b = z;
    fy = y;
    if constexpr (kind == SweepKind::revolve) {
      const PlaneVector<double> model = Rotation<double>{frame.cosine[j], frame.sine[j]}.back(a, b);
      fx = model.x;
      fz = model.z;
    } else {
      fx = a;
      fz = b;
    }
  };
  auto front = [&](int j, double& fx, double& fy, double& fz) {
    in_model(j, sx[j] - dx[j], sy[j] - dy[j], sz[j] - dz[j], fx, fy, fz);
  };
  auto behind = [&](int j, double& fx, double& fy, double& fz) {
    in_model(j, sx[j] + dx[j], sy[j] + dy[j], sz[j] + dz[j], fx, fy, fz);
  };
  front(0, first[0], first[1], first[2]);
  behind(count - 1, end[0], end[1], end[2]);
  double *x = complete, *y = x + kTile, *z = y + kTile;
  RAILSTRATA_INDEPENDENT
  for (int j = 1; j < count; ++j) {
    double ax, ay, az, bx, by, bz;
    front(j, ax, ay, az);
    behind(j - 1, bx, by, bz);
    x[j] = ax + bx;
    y[j] = ay + by;
    z[j] = az + bz;
  }
}

}  // namespace railstrata
