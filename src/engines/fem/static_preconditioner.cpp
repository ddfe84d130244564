#include "fem/static_preconditioner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Colours such that no two clusters of one colour have a neighbour in common.
std::vector<std::vector<int>> colour(const std::vector<std::vector<int>>& neighbours) {
  const int n = static_cast<int>(neighbours.size());
  std::vector<int> colour_of(n, -1);
  std::vector<std::vector<int>> classes;
  std::vector<int> taken;  // by colour: the last cluster that found it taken
  for (int a = 0; a < n; ++a) {
    taken.resize(classes.size() + 1, -1);
    for (int b : neighbours[a])
      for (int c : neighbours[b])
        if (colour_of[c] >= 0) taken[colour_of[c]] = a;
    int k = 0;
    while (taken[k] == a) ++k;
    if (k == static_cast<int>(classes.size())) classes.emplace_back();
    classes[k].push_back(a);
    colour_of[a] = k;
  }
  return classes;
}

Vec2 contact_in_section(const ContactSurface& s) { return s.node[s.columns / 2]; }

}  // namespace

StaticPreconditioner::StaticPreconditioner(const RollingSystem& system, const StaticShare& share,
                                           const Operator& stiffness)
    : sys_(system),
      share_(share),
      clusters_{Aggregates(system.rail(), contact_in_section(system.rail_surface())),
                Aggregates(system.wheel(), contact_in_section(system.wheel_surface()))},
      size_(clusters_[kRail].modes() + clusters_[kWheel].modes() + 1) {
  count_parts();
  invert_diagonal();
  probe(stiffness);
  probe_axle(stiffness);
  add_sleepers();
}

StaticVector zero_vector(const RollingSystem& system) {
  return {{system.rail().layout.field(), system.wheel().layout.field()}, 0.0};
}

void StaticPreconditioner::count_parts() {
  part_numbers_.assign(static_cast<std::size_t>(share_.ranks().count), 0);
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    const Aggregates& a = clusters_[k];
    const TileCut& cut = share_.cut(k);
    int begin = 0, end = 0;
    for (int p = 0; p < a.parts(); ++p) {
      const int owner = cut.owner_of(a.part_tile(p));
      part_numbers_[owner] += Aggregates::kPartNumbers;
      if (owner != cut.rank) continue;
      if (end == 0) begin = p;
      end = p + 1;
    }
    own_parts_[k] = {begin, end};
  }
  part_forces_.resize(static_cast<std::size_t>(Aggregates::kPartNumbers) *
                      (clusters_[kRail].parts() + clusters_[kWheel].parts()));
}

// P^T f, the same on all ranks.
void StaticPreconditioner::restrict_to(const StaticVector& f, double* coarse) {
  double* const of_body[2] = {part_forces_.data(),
                              part_forces_.data() + Aggregates::kPartNumbers * clusters_[kRail].parts()};
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    clusters_[k].restrict_parts(f.body[k], own_parts_[k].first, own_parts_[k].second, of_body[k]);
  share_.gather(part_forces_.data(), part_numbers_);
  for (std::size_t k = 0; k < clusters_.size(); ++k) clusters_[k].gather_parts(of_body[k], coarse + first_mode(k));
  coarse[size_ - 1] = f.axle;
}

// x += P c
void StaticPreconditioner::prolong(const double* coarse, StaticVector& x) const {
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    clusters_[k].prolong(coarse + first_mode(k), x.body[k], share_.kept(k));
  x.axle += coarse[size_ - 1];
}

void StaticPreconditioner::invert_diagonal() {
  inverse_ = zero_vector(sys_);
  for (std::size_t k = 0; k < sys_.bodies.size(); ++k) {
    stiffness_diagonal(sys_.bodies[k], inverse_.body[k]);
    sys_.bodies[k].ties.apply_transpose(inverse_.body[k]);
  }
  double axle = 0;
  for (const BoreNode& n : sys_.axle.bore) axle += inverse_.body[kWheel][n.index + 2 * n.stride];
  for (std::size_t k = 0; k < sys_.bodies.size(); ++k) {
    const Field& inverse_mass = sys_.bodies[k].inverse_mass;
    Field& f = inverse_.body[k];
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = inverse_mass[i] > 0 && f[i] > 0 ? 1 / f[i] : 0;
  }
  inverse_.axle = 1 / axle;
}

int StaticPreconditioner::first_mode(std::size_t body) const { return body == kRail ? 0 : clusters_[kRail].modes(); }

// The coarse matrix by columns: the stiffness is applied to one mode of all clusters of a colour at once, and shows the
// rows of their neighbours.
void StaticPreconditioner::probe(const Operator& stiffness) {
  StaticVector x = zero_vector(sys_), y = x;
  std::array<std::vector<std::vector<int>>, 2> neighbours, classes;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    neighbours[k] = clusters_[k].neighbours();
    classes[k] = colour(neighbours[k]);
    classes[k].resize(std::max(classes[0].size(), classes[k].size()));
  }
  classes[0].resize(classes[1].size());
  std::vector<double> c(static_cast<std::size_t>(size_));
  // of the probed clusters that have the mode: their column
  const auto each_column = [&](std::size_t body, std::size_t colour, int mode, auto&& visit) {
    const Aggregates& clusters = clusters_[body];
    for (int a : classes[body][colour])
      if (mode < clusters.mode_count(a)) visit(a, first_mode(body) + clusters.first_mode(a) + mode);
  };
  for (std::size_t colour = 0; colour < classes[0].size(); ++colour)
    for (int mode = 0; mode < 6; ++mode) {
      std::fill(c.begin(), c.end(), 0.0);
      for (std::size_t k = 0; k < classes.size(); ++k) {
        std::fill(x.body[k].begin(), x.body[k].end(), 0.0);
        each_column(k, colour, mode, [&](int, int column) { c[column] = 1; });
      }
      x.axle = 0;
      prolong(c.data(), x);
      stiffness(x, y);
      restrict_to(y, c.data());
      for (std::size_t k = 0; k < classes.size(); ++k)
        each_column(k, colour, mode, [&](int a, int column) {
          for (int b : neighbours[k][a])
            for (int i = 0; i < clusters_[k].mode_count(b); ++i) {
              const int row = first_mode(k) + clusters_[k].first_mode(b) + i;
              if (row >= column) coarse_.emplace_back(row, column, c[row]);
            }
        });
    }
}

void StaticPreconditioner::probe_axle(const Operator& stiffness) {
  StaticVector x = zero_vector(sys_);
  x.axle = 1.0;
  StaticVector y = x;
  stiffness(x, y);
  std::vector<double> c(static_cast<std::size_t>(size_));
  restrict_to(y, c.data());
  const int axle = size_ - 1;
  for (int i = first_mode(kWheel); i < axle; ++i)
    if (c[i] != 0) coarse_.emplace_back(axle, i, c[i]);
  coarse_.emplace_back(axle, axle, y.axle);
}

// What the pads lose because the sleepers sink, -k k/(k + k_b) s s^T with the shares s of a pad's nodes: it couples
// clusters that are no neighbours, which probes do not show.
void StaticPreconditioner::add_sleepers() {
  const RailPads& pads = sys_.pads;
  StaticVector shares = zero_vector(sys_);
  std::vector<double> c(static_cast<std::size_t>(size_));
  for (const auto& pad : pads.nodes) {
    for (const NodeShare& n : pad) shares.body[kRail][n.index + 2 * n.stride] = n.share;
    restrict_to(shares, c.data());
    for (const NodeShare& n : pad) shares.body[kRail][n.index + 2 * n.stride] = 0;
    std::vector<int> modes;
    for (int i = 0; i < size_; ++i)
      if (c[i] != 0) modes.push_back(i);
    for (const int row : modes)
      for (const int column : modes)
        if (row >= column)
          coarse_.emplace_back(row, column, -pads.track.pad_stiffness * pads.follows() * c[row] * c[column]);
  }
}

void StaticPreconditioner::set_contact(const MortarRows& rows, const std::vector<char>& active, double penalty) {
  assert(active.size() == rows.rows.size());
  gaps_.clear();
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    if (!active[k]) continue;
    const ContactRow& row = rows.rows[k];
    const double on_rail[3] = {row.normal.x, row.normal.y, row.normal.z};
    const double on_wheel[3] = {row.on_wheel.x, row.on_wheel.y, row.on_wheel.z};
    GapRow g{{}, penalty * row.area};
    for (int i = 0; i < 3; ++i) {
      if (on_rail[i] != 0) g.entry.push_back({kRail, row.rail + i * sys_.rail_surface().stride, -on_rail[i]});
      if (on_wheel[i] == 0) continue;
      for (int w = row.first; w < row.first + row.count; ++w)
        g.entry.push_back(
            {kWheel, rows.weights[w].wheel + i * sys_.wheel_surface().stride, on_wheel[i] * rows.weights[w].m});
    }
    gaps_.push_back(std::move(g));
  }
  factorise_gaps();
  factorise_coarse();
}

// W^-1 + G D^-1 G^T
void StaticPreconditioner::factorise_gaps() {
  const int n = static_cast<int>(gaps_.size());
  if (n == 0) return;
  const auto rail = static_cast<std::ptrdiff_t>(inverse_.body[kRail].size());
  const auto column_of = [&](const Entry& e) { return e.body == kWheel ? rail + e.index : e.index; };
  std::vector<std::ptrdiff_t> columns;
  for (const GapRow& g : gaps_)
    for (const Entry& e : g.entry) columns.push_back(column_of(e));
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k)
    for (const Entry& e : gaps_[k].entry) {
      const double flexibility = inverse_.body[e.body][e.index];
      const auto column = std::lower_bound(columns.begin(), columns.end(), column_of(e)) - columns.begin();
      entries.emplace_back(k, static_cast<int>(column), e.value * std::sqrt(flexibility));
    }
  SparseMatrix g(n, static_cast<int>(columns.size()));
  g.setFromTriplets(entries.begin(), entries.end());
  SparseMatrix s = g * SparseMatrix(g.transpose());
  for (int k = 0; k < n; ++k) s.coeffRef(k, k) += 1 / gaps_[k].stiffness;
  gap_factor_.compute(s);
  if (gap_factor_.info() != Eigen::Success)
    throw NumericalError("static preload: the contact's flexibility is not positive definite");
}

// With rows of G P, scaled so that their squares are the rows' stiffness.
void StaticPreconditioner::factorise_coarse() {
  std::vector<Eigen::Triplet<double>> rows;
  for (int k = 0; k < static_cast<int>(gaps_.size()); ++k) {
    const double scale = std::sqrt(gaps_[k].stiffness);
    for (const Entry& e : gaps_[k].entry) {
      const ContactSurface& s = sys_.surfaces[e.body];
      const Aggregates& a = clusters_[e.body];
      const int block = sys_.bodies[e.body].mesh.contact.block;
      const std::ptrdiff_t place = e.index - s.first_line, line = place / s.stride;
      const int node = static_cast<int>(line / 3), component = static_cast<int>(line % 3),
                station = static_cast<int>(place % s.stride);
      const int cluster = a.cluster_of(block, node, station);
      if (cluster < 0) continue;
      const auto modes = a.modes_at(block, node, station, component);
      const int first = first_mode(e.body) + a.first_mode(cluster);
      for (int i = 0; i < a.mode_count(cluster); ++i) rows.emplace_back(k, first + i, scale * e.value * modes[i]);
    }
  }
  SparseMatrix g(static_cast<int>(gaps_.size()), size_), stiffness(size_, size_);
  g.setFromTriplets(rows.begin(), rows.end());
  stiffness.setFromTriplets(coarse_.begin(), coarse_.end());
  const SparseMatrix contact = SparseMatrix(g.transpose()) * g;
  const SparseMatrix all = stiffness + SparseMatrix(contact.triangularView<Eigen::Lower>());
  coarse_factor_.compute(all);
  if (coarse_factor_.info() != Eigen::Success)
    throw NumericalError("static preload: the coarse stiffness is not positive definite: wheel and rail do not touch");
}

void StaticPreconditioner::apply(const StaticVector& r, StaticVector& z) {
  share_.for_kept([&](std::size_t k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    const double *inverse = inverse_.body[k].data(), *from = r.body[k].data();
    double* to = z.body[k].data();
    for (std::ptrdiff_t i = begin; i < end; ++i) to[i] = inverse[i] * from[i];
  });
  z.axle = inverse_.axle * r.axle;
  if (!gaps_.empty()) {
    Eigen::VectorXd gap(static_cast<int>(gaps_.size()));
    for (int k = 0; k < gap.size(); ++k) {
      gap[k] = 0;
      // fused by name: a compiler may add the products in packs, and the iterations would take another path
      for (const Entry& e : gaps_[k].entry) gap[k] = std::fma(e.value, z.body[e.body][e.index], gap[k]);
    }
    const Eigen::VectorXd force = gap_factor_.solve(gap);
    for (int k = 0; k < gap.size(); ++k)
      for (const Entry& e : gaps_[k].entry)
        z.body[e.body][e.index] -= inverse_.body[e.body][e.index] * e.value * force[k];
  }
  Eigen::VectorXd c(size_);
  restrict_to(r, c.data());
  const Eigen::VectorXd coarse = coarse_factor_.solve(c);
  prolong(coarse.data(), z);
}

}  // namespace railstrata
