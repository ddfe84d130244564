#include "fem/static_share.hpp"

namespace railstrata {
namespace {

// Section nodes of a body that the right-hand side reads at all stations.
NodeMask read_lines(const SweptBody& mesh) {
  NodeMask out = nodes_on_lines(mesh);
  for (const SectionNode& n : mesh.on_pads) out[n.block][n.node] = 1;
  if (mesh.kind == SweepKind::revolve)
    for (const SectionNode& n : mesh.prescribed) out[n.block][n.node] = 1;
  return out;
}

std::vector<Chain> own_chains(const Body& body, const TileCut& cut) {
  constexpr int kChainsPerThread = 8;
  std::vector<Chain> out;
  for (const Chain& c : chains(body.tiling, kChainsPerThread * max_threads(), cut))
    if (cut.is_own(c.first_tile)) out.push_back(c);
  return out;
}

// In eight sums, so that a compiler may use packs of any width and the order is still one.
double product_sum(const double* a, const double* b, int count) {
  constexpr int kSums = 8;
  double sum[kSums] = {};
  int j = 0;
  for (; j + kSums <= count; j += kSums)
    for (int l = 0; l < kSums; ++l) sum[l] += a[j + l] * b[j + l];
  for (int l = 0; j < count; ++j, ++l) sum[l] += a[j] * b[j];
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

}  // namespace

StaticShare::StaticShare(const RollingSystem& system, const Ranks& ranks)
    : sys_(system),
      ranks_(ranks),
      exchange_(ranks),
      cuts_(cut_tiles({&system.rail(), &system.wheel()}, ranks.count, ranks.rank)),
      stretches_(all_stretches({&system.rail(), &system.wheel()}, cuts_)),
      elements_{Traversal(system.rail()), Traversal(system.wheel())},
      tile_counts_(static_cast<std::size_t>(ranks.count)) {
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    kept_[k] = kept_values(sys_.bodies[k], cuts_[k], read_lines(sys_.bodies[k].mesh));
    own_[k] = own_chains(sys_.bodies[k], cuts_[k]);
  }
  for (const Stretch& s : stretches_) {
    borders_[s.body].push_back(s);
    tile_counts_[s.owner] += s.end_tile - s.first_tile;
  }
  cut_into_pieces();
  for (std::size_t k = 0; k < kept_.size(); ++k)
    for (std::size_t b = 0; b < kept_[k].line.size(); ++b) {
      const BlockLayout& l = sys_.bodies[k].layout.blocks[b];
      const std::vector<StationRange> whole = {{0, l.stations}};
      for (int n = 0; n < l.nodes; ++n)
        for (int i = 0; i < 3; ++i)
          for (const StationRange& run : kept_[k].line[b][n] ? whole : kept_[k].runs[b])
            ranges_.push_back({k, l.line(n, i) + run.begin, l.line(n, i) + run.end});
    }
}

void StaticShare::cut_into_pieces() {
  constexpr int kNodes = 40;
  int row = 0;
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Body& body = sys_.bodies[k];
    for (int t = 0; t < static_cast<int>(body.tiling.tiles.size()); ++t, ++row) {
      if (!cuts_[k].is_own(t)) continue;
      const int block = body.tiling.tiles[t].block, nodes = body.layout.blocks[block].nodes;
      for (int n = 0; n < nodes; n += kNodes)
        pieces_.push_back({k, block, n, std::min(n + kNodes, nodes), row, own_stations(body, t)});
    }
  }
  piece_sums_.resize(pieces_.size());
  tile_sums_.resize(static_cast<std::size_t>(row));
}

double StaticShare::dot(const StaticVector& a, const StaticVector& b) {
  for_each(static_cast<std::ptrdiff_t>(pieces_.size()), [&](std::ptrdiff_t k) {
    const Piece& piece = pieces_[k];
    const BlockLayout& l = sys_.bodies[piece.body].layout.blocks[piece.block];
    double sum = 0;
    for (int n = piece.first_node; n < piece.end_node; ++n)
      for (int i = 0; i < 3; ++i) {
        const std::ptrdiff_t at = l.line(n, i) + piece.stations.begin;
        sum += product_sum(a.body[piece.body].data() + at, b.body[piece.body].data() + at,
                           piece.stations.end - piece.stations.begin);
      }
    piece_sums_[k] = sum;
  });
  std::fill(tile_sums_.begin(), tile_sums_.end(), 0.0);
  for (std::size_t k = 0; k < pieces_.size(); ++k) tile_sums_[pieces_[k].tile] += piece_sums_[k];
  gather(tile_sums_.data(), tile_counts_);
  double sum = 0;
  for (double of_tile : tile_sums_) sum += of_tile;
  return sum + a.axle * b.axle;
}

void StaticShare::add(StaticVector& y, double s, const StaticVector& x) const {
  for_kept([&](std::size_t k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    double* to = y.body[k].data();
    const double* from = x.body[k].data();
    for (std::ptrdiff_t i = begin; i < end; ++i) to[i] += s * from[i];
  });
  y.axle += s * x.axle;
}

void StaticShare::scale_and_add(StaticVector& y, double s, const StaticVector& x) const {
  for_kept([&](std::size_t k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    double* to = y.body[k].data();
    const double* from = x.body[k].data();
    for (std::ptrdiff_t i = begin; i < end; ++i) to[i] = from[i] + s * to[i];
  });
  y.axle = x.axle + s * y.axle;
}

void StaticShare::linear_force(StaticVector& x, StaticVector& y) {
  for (std::size_t k = 0; k < elements_.size(); ++k) elements_[k].linear_force(x.body[k], y.body[k], &own_[k]);
  share_forces(y);
}

void StaticShare::internal_force(StaticVector& u, const std::array<PlasticHistory, 2>& history, StaticVector& y) {
  for (std::size_t k = 0; k < elements_.size(); ++k)
    elements_[k].internal_force(u.body[k], 0, y.body[k], history[k], &own_[k]);
  share_forces(y);
}

// On the planes between stretches from both sides, and on the lines.
void StaticShare::share_forces(StaticVector& y) {
  if (ranks_.alone()) return;
  exchange_([&](int rank, auto&& visit) {
    for (const Stretch& s : stretches_) {
      if (s.owner != rank) continue;
      const BlockLayout& l = sys_.bodies[s.body].layout.blocks[s.block];
      const std::ptrdiff_t plane = static_cast<std::ptrdiff_t>(l.nodes) * 3;
      visit(elements_[s.body].front_forces(s.first_tile), plane);
      visit(elements_[s.body].rear_forces(s.end_tile - 1), plane);
      for (int n = 0; n < l.nodes; ++n)
        for (int i = 0; i < 3 && kept_[s.body].line[s.block][n]; ++i)
          visit(y.body[s.body].data() + l.line(n, i) + s.first, s.end - s.first);
    }
  });
  for (std::size_t k = 0; k < elements_.size(); ++k) elements_[k].end(borders_[k], y.body[k]);
}

void StaticShare::gather(double* all, const std::vector<std::ptrdiff_t>& sizes) const {
  if (!ranks_.alone()) ranks_.gather(all, sizes.data());
}

void StaticShare::complete(StaticVector& x) {
  if (ranks_.alone()) return;
  exchange_([&](int rank, auto&& visit) {
    for (const Stretch& s : stretches_) {
      if (s.owner != rank) continue;
      const BlockLayout& l = sys_.bodies[s.body].layout.blocks[s.block];
      for (int n = 0; n < l.nodes; ++n)
        for (int i = 0; i < 3; ++i) visit(x.body[s.body].data() + l.line(n, i) + s.first, s.end - s.first);
    }
  });
}

}  // namespace railstrata
