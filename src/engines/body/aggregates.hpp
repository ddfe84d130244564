#pragma once
// A body cut into clusters of nodes for the coarse space of the static solver: clusters of section nodes times groups
// of stations, block by block. Clusters are small near the contact and grow with the distance from it, where the
// solution is smooth. Smaller ones: fewer iterations, a larger coarse matrix; the result does not depend on them.
//
// Each cluster moves as a rigid body, u = t + w x (X - X_c)/l, in a basis that is orthonormal over its free nodes
// (clusters on a line or in a point have fewer than six). [VanekMandelBrezina1996] A cluster's forces are summed over
// its stations within one tile after the other, so results depend neither on the number of threads nor on which rank
// has which tile.
#include <Eigen/Core>

#include "body/body.hpp"
#include "body/tile_cut.hpp"

namespace railstrata {

class Aggregates {
 public:
  Aggregates(const Body& body, Vec2 contact);

  int clusters() const { return static_cast<int>(cluster_.size()); }
  int modes() const { return modes_; }  ///< of all clusters
  int first_mode(int cluster) const { return cluster_[cluster].first_mode; }
  int mode_count(int cluster) const { return cluster_[cluster].count; }
  int cluster_of(int block, int node, int station) const;  ///< -1: constrained

  /// out = P^T f, out of length modes(), in two: the forces on the parts that tiles have of clusters, kPartNumbers of
  /// each, and what they make. Parts are in the order of their tiles.
  static constexpr int kPartNumbers = 6;
  int parts() const { return static_cast<int>(part_.size()); }
  int part_tile(int part) const { return part_[part].tile; }
  void restrict_parts(const Field& f, int begin, int end, double* forces) const;
  void gather_parts(const double* forces, double* out) const;
  /// u += P c, of what is kept.
  void prolong(const double* c, Field& u, const KeptValues& kept) const;
  /// Row of P of one displacement component of a free node: values of the modes of its cluster.
  Eigen::Matrix<double, 6, 1> modes_at(int block, int node, int station, int component) const;

  /// Clusters that share an element, directly or through hanging nodes; [cluster] -> sorted list with the cluster
  /// itself.
  std::vector<std::vector<int>> neighbours() const;

 private:
  struct Cluster {
    int block, section, first_station, stations, first_mode, count;
    Vec3 centre;
    double length;
    Eigen::Matrix<double, 6, 6> basis;  // coefficients of (t, w) of the modes, by columns
  };
  struct Part {
    int cluster, tile, first, end;  // stations
  };
  struct BlockCut {
    std::vector<std::vector<int>> section;  // clusters of section nodes
    std::vector<int> section_of;            // per section node, -1: constrained
    std::vector<int> group_of;              // per station
    std::vector<int> group_first;           // and one past the end
    int first_cluster = 0;
  };
  void cut_section(int block, std::vector<int> nodes, Vec2 contact);
  void cut_stations(int block, double radius);
  void add_cluster(int block, int section, int group);
  Eigen::Matrix<double, 3, 6> rigid_modes(const Cluster& c, int node, int station) const;

  Vec3 arm(const BlockLayout& l, int node, int station) const {
    const double* a = arm_.data() + l.line(node, 0) + station;
    return {a[0], a[l.stride], a[2 * l.stride]};
  }

  const Body& body_;
  std::vector<BlockCut> cut_;
  Field arm_;  // X - X_c of the free nodes
  std::vector<Cluster> cluster_;
  std::vector<Part> part_;                  // by tile
  std::vector<std::vector<int>> parts_of_;  // per cluster, in the order of stations
  int modes_ = 0;
};

}  // namespace railstrata
