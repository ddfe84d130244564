#pragma once
// The part of the static problem that one of several ranks computes.
//
// A rank evaluates the elements of its own tiles (body/tile_cut.hpp) and keeps vectors up to date at the nodes there,
// on the planes between stretches, and on the lines that ties, contact and axle read; those every rank has, as in the
// steps (fem/rank_exchange.hpp). A sum over a vector is made of sums over parts of tiles, each by the rank that has the
// tile, and added in the order of tiles by every rank: the same bits for any number of ranks and threads. One rank
// alone has all tiles and exchanges nothing.
#include <array>
#include <vector>

#include "body/tile_cut.hpp"
#include "body/traversal.hpp"
#include "core/parallel.hpp"
#include "fem/part_exchange.hpp"
#include "fem/rolling_system.hpp"

namespace railstrata {

/// A vector of the static problem: displacements (or forces) of both bodies and of the axle's height.
struct StaticVector {
  std::array<Field, 2> body;  ///< by BodyId
  double axle = 0;            ///< m or N
};

class StaticShare {
 public:
  /// Throws CaseError if there are more ranks than tiles.
  StaticShare(const RollingSystem& system, const Ranks& ranks);

  const Ranks& ranks() const { return ranks_; }
  const TileCut& cut(std::size_t body) const { return cuts_[body]; }
  const KeptValues& kept(std::size_t body) const { return kept_[body]; }
  Traversal& elements(std::size_t body) { return elements_[body]; }

  /// work(body, begin, end): what is kept, as ranges of memory, in parallel.
  template <class Work>
  void for_kept(Work&& work) const {
    for_each(static_cast<std::ptrdiff_t>(ranges_.size()),
             [&](std::ptrdiff_t k) { work(ranges_[k].body, ranges_[k].begin, ranges_[k].end); });
  }

  double dot(const StaticVector& a, const StaticVector& b);
  /// y += s x
  void add(StaticVector& y, double s, const StaticVector& x) const;
  /// y = x + s y
  void scale_and_add(StaticVector& y, double s, const StaticVector& x) const;

  /// y = K x of the elements, y.axle left alone.
  void linear_force(StaticVector& x, StaticVector& y);
  /// y = internal forces at displacements u, history by body.
  void internal_force(StaticVector& u, const std::array<PlasticHistory, 2>& history, StaticVector& y);

  /// Numbers in the order of the tiles that they belong to, sizes[r] of rank r: to every rank.
  void gather(double* all, const std::vector<std::ptrdiff_t>& sizes) const;
  /// x everywhere on every rank.
  void complete(StaticVector& x);

 private:
  struct Range {
    std::size_t body;
    std::ptrdiff_t begin, end;
  };
  struct Piece {  // of a tile: some nodes of its section
    std::size_t body;
    int block, first_node, end_node, tile;  // in the row of all tiles
    StationRange stations;
  };
  void cut_into_pieces();
  void share_forces(StaticVector& y);

  const RollingSystem& sys_;
  Ranks ranks_;
  PartExchange exchange_;
  std::vector<TileCut> cuts_;
  std::vector<Stretch> stretches_;
  std::array<KeptValues, 2> kept_;
  std::array<Traversal, 2> elements_;
  std::array<std::vector<Chain>, 2> own_, borders_;
  std::vector<Range> ranges_;
  std::vector<Piece> pieces_;  // of this rank's tiles
  std::vector<double> piece_sums_, tile_sums_;
  std::vector<std::ptrdiff_t> tile_counts_;  // by rank
};

}  // namespace railstrata
