#include "section/section_interior.hpp"

#include <algorithm>
#include <array>

#include "core/parallel.hpp"
#include "section/section_compliance.hpp"
#include "section/wave_factor.hpp"

namespace railstrata {

namespace {

/// Directions at the surface, in the section's plane.
struct SurfaceAxes {
  Vec2 along, into;
};

SurfaceAxes axes_between(Vec2 from, Vec2 to, bool revolved) {
  const Vec2 along = (1 / norm(to - from)) * (to - from);
  return {along, revolved ? Vec2{-along.z, along.y} : Vec2{along.z, -along.y}};
}

/// The state in these axes by the strains at a point.
Eigen::Matrix<double, 6, 6> state_of_strains(const SurfaceAxes& axes, const Elastic& material) {
  const auto [t, n] = axes;
  const double G = material.mu, lambda = material.lambda;
  Eigen::Matrix<double, 6, 6> out;                                                 // of xx, yy, zz, yz, xz, xy
  out << 1, 0, 0, 0, 0, 0,                                                         //
      0, t.y * t.y, t.z * t.z, t.y * t.z, 0, 0,                                    //
      0, 0, 0, 0, 0.5 * t.z, 0.5 * t.y,                                            //
      0, 0, 0, 0, G * n.z, G * n.y,                                                //
      0, 2 * G * t.y * n.y, 2 * G * t.z * n.z, G * (t.y * n.z + t.z * n.y), 0, 0,  //
      lambda, lambda + 2 * G * n.y * n.y, lambda + 2 * G * n.z * n.z, 2 * G * n.y * n.z, 0, 0;
  return out;
}

/// The states as B0 + k B1 times the displacements of the free nodes.
struct Sampling {
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  Rows b0, b1;
};

int first_element(const SweptBody& body) {
  int first = 0;
  for (int b = 0; b < body.contact.block; ++b) first += static_cast<int>(body.blocks[b].section.quads.size());
  return first;
}

SurfaceAxes axes_of_column(const QuadraticSection& mesh, int column, bool revolved) {
  return axes_between(mesh.nodes[mesh.surface[2 * column]], mesh.nodes[mesh.surface[2 * column + 2]], revolved);
}

std::vector<BandElement> elements_of(const SweptBody& body, const QuadraticSection& mesh,
                                     const std::vector<Elastic>& materials, bool revolved) {
  const ContactBand& band = body.contact;
  const int first = first_element(body);
  std::vector<BandElement> out;
  std::vector<double> top(static_cast<std::size_t>(band.columns), 0.0);
  for (int r = 0; r < band.rows; ++r)
    for (int c = 0; c < band.columns; ++c) {
      const int element = first + r * band.columns + c, material = mesh.material[element];
      const std::array<int, 8>& nodes = mesh.elements[element];
      const Vec2 surface = mesh.nodes[mesh.surface[2 * c + 1]], into = axes_of_column(mesh, c, revolved).into;
      double bottom = 0;
      for (std::size_t n = 4; n < 8; ++n) bottom = std::max(bottom, dot(mesh.nodes[nodes[n]] - surface, into));
      out.push_back({0.5 * (top[c] + bottom),
                     bottom,
                     body.layer_of(material),
                     {young(materials[material]), poisson(materials[material])}});
      top[c] = bottom;
    }
  return out;
}

Sampling sampling_of(const SweptBody& body, const QuadraticSection& mesh, const std::vector<Elastic>& materials,
                     double radius) {
  const ContactBand& band = body.contact;
  const int first = first_element(body);
  std::array<std::vector<Eigen::Triplet<double>>, 2> entries;
  for (int r = 0; r < band.rows; ++r)
    for (int c = 0; c < band.columns; ++c) {
      const int point = r * band.columns + c, element = first + point;
      std::array<Vec2, 8> x;
      for (std::size_t n = 0; n < 8; ++n) x[n] = mesh.nodes[mesh.elements[element][n]];
      const Eigen::Matrix<double, 6, 6> state =
          state_of_strains(axes_of_column(mesh, c, radius > 0), materials[mesh.material[element]]);
      const PointStrains strains = point_strains(x, 0, 0, radius);
      const std::array<Eigen::Matrix<double, 6, 24>, 2> parts{state * strains.b0, state * strains.b1};
      for (int i = 0; i < 24; ++i)
        for (const auto& [node, share] : mesh.shares[mesh.elements[element][i / 3]])
          for (std::size_t j = 0; j < 2; ++j)
            for (int s = 0; s < 6; ++s)
              entries[j].emplace_back(6 * point + s, 3 * node + i % 3, share * parts[j](s, i));
    }
  Sampling out;
  for (auto* part : {&out.b0, &out.b1}) {
    part->resize(6 * band.rows * band.columns, 3 * mesh.free_nodes);
    part->setFromTriplets(entries[part == &out.b1].begin(), entries[part == &out.b1].end());
  }
  return out;
}

}  // namespace

SectionInterior section_interior(const SweptBody& body, const QuadraticSection& mesh, const SectionStiffness& stiffness,
                                 const std::vector<Elastic>& materials, double radius, const std::vector<double>& k) {
  const ContactBand& band = body.contact;
  const int count = station_count(mesh, 1);
  SectionInterior out;
  out.k = k;
  out.at.resize(k.size());
  for (int c = 0; c < band.columns; ++c) out.columns.push_back(mesh.nodes[mesh.surface[2 * c + 1]]);
  out.elements = elements_of(body, mesh, materials, radius > 0);
  Eigen::MatrixXd loads = hat_loads(mesh, 1, count);
  for (int m = 0; m < count; ++m) {
    const int corner = 2 * (m + 1);
    out.stations.push_back(mesh.nodes[mesh.surface[corner]]);
    const SurfaceAxes axes =
        axes_between(mesh.nodes[mesh.surface[corner - 1]], mesh.nodes[mesh.surface[corner + 1]], radius > 0);
    const Eigen::MatrixXd by_y = loads.col(3 * m + 1), by_z = loads.col(3 * m + 2);
    loads.col(3 * m + 1) = axes.along.y * by_y + axes.along.z * by_z;
    loads.col(3 * m + 2) = axes.into.y * by_y + axes.into.z * by_z;
  }
  const WaveFactor::Rows forces = loads;
  const Sampling sampling = sampling_of(body, mesh, materials, radius);
  for_each_that_throws(k.size(), [&](std::size_t i) {
    const WaveFactor::Rows u = WaveFactor(stiffness.at(k[i])).solve(forces);
    const WaveFactor::Rows states = Sampling::Rows(sampling.b0 + k[i] * sampling.b1) * u;
    out.at[i] = states;
  });
  return out;
}

}  // namespace railstrata
