// The end of a stiff layer under a rolling line contact of fixed pressure, in plane strain, against independent finite
// elements on meshes of 0.05 and 0.02 mm (docs/along.md): a = 6 mm, p0 = 1000 MPa, a 3 mm layer of twice the modulus at
// x < 0. Von Mises stress of means over 1 mm by 1 mm.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

#include "body/stress.hpp"
#include "mesh/grading.hpp"
#include "tests/body/sample_bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kHalf = 6e-3, kPeak = 1e9, kMm = 1e-3, kFine = 24e-3, kFar = 1.0;
constexpr double kSmall = 1e-4;  // of the load, so that strains are small

enum class Layer { none, endless, ends };

/// A slice of 1 mm across, one element wide, in elements of `size` near the contact.
SweptBody slice(Layer layer, double size) {
  std::vector<double> depth;
  for (int r = 0; r <= std::lround(kFine / size); ++r) depth.push_back(size * r);
  for (double step : growing_spacings(kFar, size, 1.2, 0.2)) depth.push_back(depth.back() + step);
  SweptBody body = mesh_brick(1, static_cast<int>(depth.size()) - 1, 1, kMm, kMm, kMm);
  Block& block = body.blocks[0];
  for (std::size_t n = 0; n < block.section.nodes.size(); ++n) block.section.nodes[n].z = -depth[n / 2];
  block.stations.at = extruded_stations(-kFine, kFine, size, 1, kFar, 0.2).fine;
  const std::vector<int> matrix = block.section.quad_material;
  if (layer == Layer::none) return body;
  for (int r = 0; r < std::lround(3 * kMm / size); ++r) block.section.quad_material[static_cast<std::size_t>(r)] = 1;
  if (layer == Layer::endless) return body;
  block.along.sets = {block.section.quad_material, matrix};
  for (int e = 0; e < block.stations.elements(); ++e)
    block.along.of_element.push_back(block.stations.at[e + 1] < 1e-9 ? 0 : 1);
  return body;
}

double pressure(double x) { return x * x < kHalf * kHalf ? kPeak * std::sqrt(1 - x * x / (kHalf * kHalf)) : 0; }

/// Plane strain: nothing moves across, and both sides of the slice move alike.
class Slice {
 public:
  Slice(Layer layer, double size)
      : size_(size), body_(slice(layer, size), {kSteel, elastic(420e9, 0.3, 7800)}, {}), lay_(body_.layout.blocks[0]) {
    rows_ = static_cast<int>(body_.mesh.blocks[0].section.quads.size());  // the lowest nodes are held
    assemble();
  }

  /// MPa, the von Mises stress of the mean over the box of 1 mm from x and a depth on, under the contact at `centre`
  /// with tractions f p along the way.
  double von_mises_in(double x, int depth, double centre, double f) const {
    const Field u = under(centre, f);
    const int n = static_cast<int>(std::lround(kMm / size_));
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    const auto first = static_cast<int>(std::lower_bound(at.begin(), at.end(), x - 1e-9) - at.begin());
    Sym3 sum;
    for (int e = 0; e < n; ++e)
      for (int r = 0; r < n; ++r)
        sum = sum + element_stress(body_, u, initial_history(body_), 0, depth * n + r, first + e);
    return 1e-6 * von_mises((1.0 / (kSmall * n * n)) * sum);
  }

 private:
  int unknown(int row, int station, int part) const { return 2 * (station * rows_ + row) + part; }
  std::ptrdiff_t place(int side, int row, int station, int part) const {
    return lay_.line(2 * row + side, 2 * part) + station;
  }

  /// The stiffness by forces of displacements of every third node in both directions.
  void assemble() {
    const int n = 2 * rows_ * lay_.stations;
    std::vector<Eigen::Triplet<double>> entries;
    Traversal traversal(body_);
    for (int colour = 0; colour < 18; ++colour) {
      const int part = colour % 2, row0 = colour / 2 % 3, station0 = colour / 6;
      Field u = body_.layout.field(), f = body_.layout.field();
      for (int j = station0; j < lay_.stations; j += 3)
        for (int r = row0; r < rows_; r += 3)
          for (int side : {0, 1}) u[place(side, r, j, part)] = 1;
      traversal.linear_force(u, f);
      for (int j = station0; j < lay_.stations; j += 3)
        for (int r = row0; r < rows_; r += 3)
          for (int b = std::max(j - 1, 0); b <= std::min(j + 1, lay_.stations - 1); ++b)
            for (int a = std::max(r - 1, 0); a <= std::min(r + 1, rows_ - 1); ++a)
              for (int to : {0, 1})
                entries.emplace_back(unknown(a, b, to), unknown(r, j, part),
                                     f[place(0, a, b, to)] + f[place(1, a, b, to)]);
    }
    Eigen::SparseMatrix<double> k(n, n);
    k.setFromTriplets(entries.begin(), entries.end());
    solver_.compute(k);
    EXPECT_EQ(solver_.info(), Eigen::Success);
  }

  Field under(double centre, double f) const {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * rows_ * lay_.stations);
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    constexpr int kPoints = 100;
    for (int e = 0; e + 1 < lay_.stations; ++e)
      for (int k = 0; k < kPoints; ++k) {
        const double t = (k + 0.5) / kPoints, length = at[e + 1] - at[e];
        const double force = kSmall * pressure(at[e] + t * length - centre) * length / kPoints * kMm;
        for (int part : {0, 1}) {
          const double own = part == 0 ? f * force : -force;
          b[unknown(0, e, part)] += (1 - t) * own;
          b[unknown(0, e + 1, part)] += t * own;
        }
      }
    const Eigen::VectorXd x = solver_.solve(b);
    Field u = body_.layout.field();
    for (int j = 0; j < lay_.stations; ++j)
      for (int r = 0; r < rows_; ++r)
        for (int part : {0, 1})
          for (int side : {0, 1}) u[place(side, r, j, part)] = x[unknown(r, j, part)];
    return u;
  }

  double size_;
  Body body_;
  const BlockLayout& lay_;
  int rows_ = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

struct Box {
  const char* name;
  double x;  // mm, where it begins
  int depth;
  double free_at, free_mises, pulled_at, pulled_mises;  // mm and MPa, without and with f = 0.3
};
constexpr Box kBoxes[] = {{"clad surface", -1, 0, 0, 411, -6, 620},  {"parent surface", 0, 0, 1, 383, -5, 611},
                          {"clad corner", -1, 2, -3, 641, -5, 749},  {"parent below", -1, 3, -2, 605, -4, 667},
                          {"parent beside", 0, 2, -4, 499, -4, 646}, {"parent diagonal", 0, 3, -3, 560, -4, 679}};

TEST(LayerEnd, MeansBesideItAreThoseOfIndependentFiniteElements) {
  const Slice ending(Layer::ends, 0.5 * kMm);
  for (const Box& box : kBoxes) {
    const double free = ending.von_mises_in(kMm * box.x, box.depth, kMm * box.free_at, 0),
                 pulled = ending.von_mises_in(kMm * box.x, box.depth, kMm * box.pulled_at, 0.3);
    EXPECT_NEAR(free / box.free_mises, 1, 0.04) << box.name;
    EXPECT_NEAR(pulled / box.pulled_mises, 1, 0.04) << box.name << ", f = 0.3";
  }
}

TEST(LayerEnd, EndlessBodiesAreMet) {
  const Slice endless(Layer::endless, 0.5 * kMm), alone(Layer::none, 0.5 * kMm);
  const auto largest = [](const Slice& slice, int depth) {
    double out = 0;
    for (int at = -8; at <= 8; ++at) out = std::max(out, slice.von_mises_in(-kMm, depth, kMm * at, 0));
    return out;
  };
  for (const auto& [depth, layered, homogeneous] :
       {std::tuple{0, 456.0, 389.0}, {2, 551.0, 517.0}, {3, 571.0, 550.0}}) {
    EXPECT_NEAR(largest(endless, depth) / layered, 1, 0.04) << depth;
    EXPECT_NEAR(largest(alone, depth) / homogeneous, 1, 0.04) << depth;
  }
}

}  // namespace
}  // namespace railstrata
