#pragma once
// The meshed case as other finite element programs take it: nodes, hexahedra, hanging nodes as linear equations,
// surfaces and loads of the static preload. Model frame (x rolling direction, z up), metres; the writers convert.
#include <array>
#include <string>
#include <vector>

#include "core/body_id.hpp"
#include "material/elastic.hpp"
#include "model/model.hpp"

namespace railstrata {

/// u[node] = sum of weight times u[carrier], for each of the three components; carriers hang nowhere themselves.
struct HangingNode {
  struct Carrier {
    long node;
    double weight;
  };
  long node = 0;
  std::vector<Carrier> carriers;
};

/// A face of an element on a running surface: the edge k of the quadrilateral (its corners k and k + 1) at both
/// stations.
struct SurfaceFace {
  long cell = 0;
  int edge = 0;                 ///< 0 … 3
  std::array<long, 4> nodes{};  ///< anticlockwise seen from outside the body
};

/// Nodes and cells count from 0.
struct SolidBody {
  BodyId id = BodyId::rail;
  std::vector<Vec3> points;                 ///< m
  std::vector<std::array<long, 8>> cells;   ///< corners in VTK's order, which is that of Abaqus and LS-DYNA
  std::vector<int> material;                ///< of each cell, index into materials
  std::vector<Elastic> materials;           ///< matrix, then the layers (rows of a graded one) from the surface down
  std::vector<std::string> material_names;  ///< as the case has them
  std::vector<HangingNode> hanging;
  std::vector<long> prescribed;   ///< rail: fixed; wheel: on the rigid axle. None of them hangs
  std::vector<SurfaceFace> face;  ///< of the running surface where the patch may lie
};

struct SolidModel {
  std::string title;
  SolidBody rail, wheel;
  Vec3 axle;                ///< m, centre of the axle
  double axle_load = 0;     ///< N, downwards: what the wheel carries, and its own mass that is not meshed
  double approach = 0;      ///< m, Hertz's estimate
  double p_max = 0;         ///< Pa, likewise
  double a = 0, b = 0;      ///< m, semi-axes of the patch along x and y, likewise
  double element_size = 0;  ///< m, at the running surfaces
  double friction = 0;      ///< friction coefficient of the case
  bool one_point = false;   ///< mesh.element
  double static_load = 0;   ///< N, on the rail
};

/// How far the largest nodal pressure may lie below the top of the parabolas through it and its neighbours, as a share
/// of the top: for Hertz's pressure with its middle between four nodes, on the patch that the bodies would have if they
/// were of their stiffest layers throughout.
double missed_by_nodes(const SolidModel& model);

/// Throws CaseError as build_model does, and for a case that finite elements do not take.
SolidModel solid_model(const Model& model);

}  // namespace railstrata
