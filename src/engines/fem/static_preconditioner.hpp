#pragma once
// Two-level additive preconditioner of the static problem A = K + G^T W G (K: both elastic bodies and the axle, G: gaps
// of the rows in contact, W = penalty x area):
//
//   M^-1 = (D + G^T W G)^-1 + P (P^T A P)^-1 P^T
//
// D is the diagonal of K; the contact's stiffness enters the first term exactly, through the small sparse matrix W^-1 +
// G D^-1 G^T (Sherman, Morrison, Woodbury), so that a stiff penalty costs no iterations. P holds the rigid-body modes
// of clusters of nodes (body/aggregates.hpp) and the axle's height: the long waves and the nearly free motion of the
// wheel on its contact, which a diagonal alone needs thousands of iterations for. P^T K P is found by applying K to the
// modes of many clusters that do not touch at once.
//
// With several ranks, each restricts and prolongs at the stations of its own tiles; every rank has both factors.
#include <Eigen/SparseCholesky>
#include <functional>

#include "body/aggregates.hpp"
#include "fem/static_share.hpp"

namespace railstrata {

/// Sized for the system.
StaticVector zero_vector(const RollingSystem& system);

class StaticPreconditioner {
 public:
  /// stiffness(x, y): y = K x on the free degrees of freedom, without contact, sleepers standing still.
  using Operator = std::function<void(StaticVector&, StaticVector&)>;
  /// share: of this rank; vectors are right where it keeps them.
  StaticPreconditioner(const RollingSystem& system, const StaticShare& share, const Operator& stiffness);

  /// The rows in contact and their stiffness (Pa/m); factorises both levels.
  void set_contact(const MortarRows& rows, const std::vector<char>& active, double penalty);
  /// z = M^-1 r
  void apply(const StaticVector& r, StaticVector& z);

 private:
  using Cholesky = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;
  struct Entry {
    std::size_t body;  // by BodyId
    std::ptrdiff_t index;
    double value;
  };
  struct GapRow {
    std::vector<Entry> entry;
    double stiffness;  // N/m
  };
  int first_mode(std::size_t body) const;
  void count_parts();
  void restrict_to(const StaticVector& f, double* coarse);
  void prolong(const double* coarse, StaticVector& x) const;
  void invert_diagonal();
  void probe(const Operator& stiffness);
  void probe_axle(const Operator& stiffness);
  void add_sleepers();
  void factorise_gaps();
  void factorise_coarse();

  const RollingSystem& sys_;
  const StaticShare& share_;
  std::array<Aggregates, 2> clusters_;        // by BodyId
  std::vector<double> part_forces_;           // of the clusters' parts, both bodies
  std::vector<std::ptrdiff_t> part_numbers_;  // of them, by rank
  std::array<std::pair<int, int>, 2> own_parts_;
  int size_ = 0;
  StaticVector inverse_;
  std::vector<GapRow> gaps_;
  std::vector<Eigen::Triplet<double>> coarse_;
  Cholesky gap_factor_, coarse_factor_;
};

}  // namespace railstrata
