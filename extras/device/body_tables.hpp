#pragma once
// A body's constant data on a device: made once from a RollingBody.
#include <optional>
#include <string>

#include "device/body_kernels.hpp"
#include "device/element_kernels.hpp"
#include "fem/rolling_body.hpp"

namespace railstrata::device {

/// Arrays of the elements whose arithmetic is in Real.
template <class Real>
struct ElementArrays {
  DeviceArray<HexReference<Real>> references;
  DeviceArray<Real> hourglass, eigenstress;
  DeviceArray<Real> inv_sigma, inv_c, sigma_c, sigma, c;
  DeviceArray<Real> rows;  ///< work space: what elements leave for their corners
};

/// Ties of one level: no master of theirs is tied by them or by a later level.
struct TieLevel {
  DeviceArray<Piece> slaves, masters;
  DeviceArray<MasterRecord> records;
  DeviceArray<TieShare> shares;
  std::ptrdiff_t first_moment = 0;  ///< lanes of the levels before
};

struct TieArrays {
  DeviceArray<TieRecord> ties;
  DeviceArray<int> left, right, first, from;
  DeviceArray<double> weight, share, delta_x, delta_z;
  std::vector<TieLevel> levels;  ///< in the order of displacements
  std::ptrdiff_t moments = 0;    ///< lanes of all levels
  TieTables tables() const {
    return {ties.view(), left.view(),  right.view(),   weight.view(), first.view(),
            from.view(), share.view(), delta_x.view(), delta_z.view()};
  }
};

struct ChainArrays {
  DeviceArray<ChainRecord> chains;
  DeviceArray<ChainNode> nodes;
  DeviceArray<double> added, forward, pivot, backward, response;
  DeviceArray<Piece> pieces;
  DeviceArray<int> chain_at;  ///< of the surface's columns: the chain that begins there, -1: none
  ChainTables tables() const {
    return {chains.view(), nodes.view(), forward.view(), pivot.view(), backward.view(), response.view()};
  }
};

struct BodyTables {
  BodyTables(Device& device, const RollingBody& body);

  SweepKind kind;
  bool single;
  long elements = 0;
  ElementArrays<double> in_double;  ///< energies are always double; without rows where forces are single
  ElementArrays<float> in_single;
  template <class Real>
  ElementArrays<Real>& of() {
    if constexpr (std::is_same_v<Real, float>)
      return in_single;
    else
      return in_double;
  }
  DeviceArray<Piece> quad_pieces, node_pieces, waiting_pieces;
  DeviceArray<QuadRecord> quads;
  DeviceArray<NodeRecord> nodes;
  DeviceArray<std::ptrdiff_t> corners;
  DeviceArray<int> classes;
  DeviceArray<double> cos_q, sin_q, cos_node, sin_node, inverse_mass, mass;
  TieArrays ties;
  ChainArrays added_mass;
};

}  // namespace railstrata::device
