#pragma once
// Selective mass scaling of thin rows of elements: inertia against stretching across the row, none against moving with
// it.
//
// A row of height h whose pressure wave crosses it faster than a wanted step D, h < c D, limits the explicit step of
// the whole body. Each of its edges across the row, between section nodes 1 and 2 at one station, gets the added mass
// [OlovssonUnossonSimonsson2004]
//   a [1 -1; -1 1] per direction,   a = m/4 ((c D/h)^2 - 1),   m the mass of the element column of that edge, c^2 =
//   (lambda + 2 mu)/rho:
// the row's own thickness mode (omega^2 = 4 k/(m + 4 a), k = m c^2/h^2) then stands exactly at omega = 2/D. Edges join
// to chains down the rows; M + A is tridiagonal along a chain (the 2x2 pair in closed form when there is one row) and
// its inverse costs two sweeps [ConfalonieriGhisiPerego2015]. Sums of mass, statics, uniform translation and, as A is
// the same in all directions, the response to rigid rotation but for the a h^2 of rotary inertia stay what they were.
// The in-plane wave speed of the layer is unchanged, since inertia across it does not affect it. So the step comes from
// the scaled model (lanczos_stable_step).
#include <map>
#include <vector>

#include "body/body.hpp"

namespace railstrata {

class MassScaling {
 public:
  /// No added mass.
  MassScaling() = default;
  /// wanted_step D [s]: rows that a pressure wave crosses in less than D / kSlack get added mass; chains follow the
  /// section's edges. Nodes that are prescribed or carried by others (slaves) have none: their masters' edges make up
  /// for the mass they carry.
  MassScaling(const Body& body, double wanted_step);

  bool empty() const { return chains_.empty(); }
  /// The section node stands in a chain.
  bool acts_on(int block, int node) const;

  /// f <- M (M + A)^-1 f at the nodes of all chains, so that f/m is the acceleration. f: any forces on the free nodes.
  /// Same bits for any number of threads.
  void scale(Field& f) const;
  /// f <- f + M (M + A)^-1 e F: a further force F [N] at `index`, which is on the surface, where a chain begins, or in
  /// no chain.
  void add_force(Field& f, std::ptrdiff_t index, double force) const;
  /// Diagonal of M (M + A)^-1 at such an index: what is left of the velocity that an impulse gives it. Surface nodes do
  /// not feel one another within a step.
  double share(std::ptrdiff_t index) const;
  /// Differences of v across the edges (in the memory of `reuse`), and the kinetic energy of the added mass 1/2 v^T A w
  /// from those of v and from w [J] (v, w: the half steps before and after).
  Field differences(const Field& v, Field reuse = {}) const;
  double kinetic(const Field& differences_of_v, const Field& w);

  struct Report {
    double added_mass = 0;                 ///< kg, sum of a
    double scaled_mass = 0;                ///< kg, of the nodes it acts on
    std::map<int, double> added_in_block;  ///< kg, by block
  };
  const Report& report() const { return report_; }

  // -- what it is made of, for those who apply it elsewhere (device/body_tables.hpp)
  struct Chain {
    int block = 0, stations = 0;
    std::vector<int> nodes;     ///< section nodes
    std::ptrdiff_t factor = 0;  ///< start in the factors: [node][station]
  };
  const std::vector<Chain>& chains() const { return chains_; }
  struct Factors {
    const Field &added, &forward, &pivot, &backward, &response;
  };
  Factors factors() const { return {added_, forward_, pivot_, backward_, response_}; }

 private:
  struct Edge {
    std::vector<double> added;  // per station
    double total = 0;
  };
  using Edges = std::map<std::pair<int, int>, Edge>;  // by section nodes, the lower number first
  static Edges thin_edges(const SweptBody& body, int block, const std::vector<Elastic>& materials, double wanted_step);
  static std::vector<std::vector<int>> paths(const Edges& edges, int nodes);
  void add_chain(int block, const std::vector<int>& nodes, const Edges& edges, const Field& mass);
  template <class Visit>
  void each_edge(Visit&& visit) const;
  const Chain* chain_at(std::ptrdiff_t index, int& component, int& station) const;

  BodyLayout layout_;
  std::vector<Chain> chains_;
  std::vector<std::vector<int>>
      chain_of_;  // per block and section node: the chain that begins there, kNone, or kInside one
  // L D L^T of M + A along a chain: y_k = f_k + g_(k-1) y_(k-1) down, f'_k = p_k y_k + b_k f'_(k+1) up; and f' for a
  // unit force at the first node
  Field added_, forward_, pivot_, backward_, response_;
  std::vector<double> chain_energy_;  // work space
  Report report_;
};

}  // namespace railstrata
