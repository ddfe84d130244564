#include "fem/static_preconditioner.hpp"

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Colours such that no two clusters of one colour have a neighbour in common.
std::vector<std::vector<int>> colour(const Aggregates::Neighbours& neighbours) {
  const int n = static_cast<int>(neighbours.of.size());
  std::vector<int> colour_of(n, -1);
  std::vector<std::vector<int>> classes;
  std::vector<int> taken;  // by colour: the last cluster that found it taken
  for (int a = 0; a < n; ++a) {
    taken.resize(classes.size() + 1, -1);
    for (int b : neighbours.of[a])
      for (int c : neighbours.of[b])
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

StaticPreconditioner::StaticPreconditioner(const RollingSystem& system, const ClusterSizes& sizes,
                                           const Operator& stiffness)
    : sys_(system),
      rail_(system.rail, contact_in_section(system.rail_surface), sizes),
      wheel_(system.wheel, contact_in_section(system.wheel_surface), sizes),
      size_(rail_.modes() + wheel_.modes() + 1) {
  invert_diagonal();
  probe(stiffness);
  probe_axle(stiffness);
}

void StaticPreconditioner::invert_diagonal() {
  inverse_ = {sys_.rail.solid.layout().field(), sys_.wheel.solid.layout().field(), 0.0};
  sys_.rail.solid.stiffness_diagonal(inverse_.rail);
  sys_.wheel.solid.stiffness_diagonal(inverse_.wheel);
  sys_.rail.ties.collect(inverse_.rail);
  sys_.wheel.ties.collect(inverse_.wheel);
  double axle = 0;
  for (const BoreNode& n : sys_.axle.bore) axle += inverse_.wheel[n.index + 2 * n.stride];
  auto invert = [](const DeformableBody& body, Field& f) {
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = body.inverse_mass[i] > 0 && f[i] > 0 ? 1 / f[i] : 0;
  };
  invert(sys_.rail, inverse_.rail);
  invert(sys_.wheel, inverse_.wheel);
  inverse_.axle = 1 / axle;
}

void StaticPreconditioner::probe(const Operator& stiffness) {
  StaticVector x{sys_.rail.solid.layout().field(), sys_.wheel.solid.layout().field(), 0.0}, y = x;
  struct Part {
    const Aggregates& clusters;
    Aggregates::Neighbours neighbours;
    std::vector<std::vector<int>> classes;
    int offset;
    Field StaticVector::*field;
  };
  Part parts[2] = {{rail_, rail_.neighbours(), {}, 0, &StaticVector::rail},
                   {wheel_, wheel_.neighbours(), {}, rail_.modes(), &StaticVector::wheel}};
  for (Part& p : parts) p.classes = colour(p.neighbours);
  const std::size_t colours = std::max(parts[0].classes.size(), parts[1].classes.size());
  std::vector<double> c;
  for (std::size_t k = 0; k < colours; ++k)
    for (int mode = 0; mode < 6; ++mode) {
      x.axle = 0;
      for (const Part& p : parts) {
        c.assign(p.clusters.modes(), 0.0);
        if (k < p.classes.size())
          for (int a : p.classes[k])
            if (mode < p.clusters.mode_count(a)) c[p.clusters.first_mode(a) + mode] = 1;
        Field& f = x.*p.field;
        std::fill(f.begin(), f.end(), 0.0);
        p.clusters.prolong(c.data(), f);
      }
      stiffness(x, y);
      ++probes_;
      for (const Part& p : parts) {
        if (k >= p.classes.size()) continue;
        c.resize(p.clusters.modes());
        p.clusters.restrict_to(y.*p.field, c.data());
        for (int a : p.classes[k]) {
          if (mode >= p.clusters.mode_count(a)) continue;
          const int column = p.offset + p.clusters.first_mode(a) + mode;
          for (int b : p.neighbours.of[a])
            for (int i = 0; i < p.clusters.mode_count(b); ++i) {
              const int row = p.clusters.first_mode(b) + i;
              if (p.offset + row >= column) coarse_.emplace_back(p.offset + row, column, c[row]);
            }
        }
      }
    }
}

void StaticPreconditioner::probe_axle(const Operator& stiffness) {
  StaticVector x{sys_.rail.solid.layout().field(), sys_.wheel.solid.layout().field(), 1.0}, y = x;
  stiffness(x, y);
  ++probes_;
  std::vector<double> c(wheel_.modes());
  wheel_.restrict_to(y.wheel, c.data());
  const int axle = size_ - 1;
  for (int i = 0; i < wheel_.modes(); ++i)
    if (c[i] != 0) coarse_.emplace_back(axle, rail_.modes() + i, c[i]);
  coarse_.emplace_back(axle, axle, y.axle);
}

void StaticPreconditioner::set_contact(const MortarRows& rows, const std::vector<char>& active, double penalty) {
  gather_gaps(rows, active, penalty);
  factorise_gaps();
  factorise_coarse();
}

void StaticPreconditioner::gather_gaps(const MortarRows& rows, const std::vector<char>& active, double penalty) {
  gaps_.clear();
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    if (!active[k]) continue;
    const ContactRow& row = rows.rows[k];
    const double n[3] = {row.normal.x, row.normal.y, row.normal.z};
    GapRow g{{}, penalty * row.area};
    for (int i = 0; i < 3; ++i) {
      if (n[i] == 0) continue;
      g.entry.push_back({false, row.rail + i * sys_.rail_surface.stride, -n[i]});
      for (int w = row.first; w < row.first + row.count; ++w)
        g.entry.push_back({true, rows.weights[w].wheel + i * sys_.wheel_surface.stride, n[i] * rows.weights[w].m});
    }
    gaps_.push_back(std::move(g));
  }
}

// W^-1 + G D^-1 G^T
void StaticPreconditioner::factorise_gaps() {
  const int n = static_cast<int>(gaps_.size());
  if (n == 0) return;
  const auto rail = static_cast<std::ptrdiff_t>(inverse_.rail.size());
  std::vector<std::ptrdiff_t> columns;
  for (const GapRow& g : gaps_)
    for (const Entry& e : g.entry) columns.push_back(e.wheel ? rail + e.index : e.index);
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k)
    for (const Entry& e : gaps_[k].entry) {
      const double flexibility = e.wheel ? inverse_.wheel[e.index] : inverse_.rail[e.index];
      const auto column =
          std::lower_bound(columns.begin(), columns.end(), e.wheel ? rail + e.index : e.index) - columns.begin();
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

// G P of one row, scaled so that its square is the row's stiffness.
std::vector<Eigen::Triplet<double>> StaticPreconditioner::coarse_row(const GapRow& row, int number) const {
  std::vector<Eigen::Triplet<double>> out;
  const double scale = std::sqrt(row.stiffness);
  for (const Entry& e : row.entry) {
    const ContactSurface& s = e.wheel ? sys_.wheel_surface : sys_.rail_surface;
    const Aggregates& a = e.wheel ? wheel_ : rail_;
    const int block = (e.wheel ? sys_.model.wheel : sys_.model.rail).contact.block;
    const std::ptrdiff_t place = e.index - s.first_line, line = place / s.stride;
    const int node = static_cast<int>(line / 3), component = static_cast<int>(line % 3),
              station = static_cast<int>(place % s.stride);
    const int cluster = a.cluster_of(block, node, station);
    if (cluster < 0) continue;
    const auto modes = a.modes_at(block, node, station, component);
    const int first = (e.wheel ? rail_.modes() : 0) + a.first_mode(cluster);
    for (int i = 0; i < a.mode_count(cluster); ++i) out.emplace_back(number, first + i, scale * e.value * modes[i]);
  }
  return out;
}

void StaticPreconditioner::factorise_coarse() {
  std::vector<Eigen::Triplet<double>> rows;
  for (int k = 0; k < static_cast<int>(gaps_.size()); ++k) {
    const auto row = coarse_row(gaps_[k], k);
    rows.insert(rows.end(), row.begin(), row.end());
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

void StaticPreconditioner::apply(const StaticVector& r, StaticVector& z) const {
  auto scaled = [](const Field& inverse, const Field& from, Field& to) {
    for_each(static_cast<std::ptrdiff_t>(from.size()), [&](std::ptrdiff_t i) { to[i] = inverse[i] * from[i]; });
  };
  scaled(inverse_.rail, r.rail, z.rail);
  scaled(inverse_.wheel, r.wheel, z.wheel);
  z.axle = inverse_.axle * r.axle;
  if (!gaps_.empty()) {
    Eigen::VectorXd gap(static_cast<int>(gaps_.size()));
    for (int k = 0; k < gap.size(); ++k) {
      gap[k] = 0;
      for (const Entry& e : gaps_[k].entry) gap[k] += e.value * (e.wheel ? z.wheel[e.index] : z.rail[e.index]);
    }
    const Eigen::VectorXd force = gap_factor_.solve(gap);
    for (int k = 0; k < gap.size(); ++k)
      for (const Entry& e : gaps_[k].entry) {
        if (e.wheel)
          z.wheel[e.index] -= inverse_.wheel[e.index] * e.value * force[k];
        else
          z.rail[e.index] -= inverse_.rail[e.index] * e.value * force[k];
      }
  }
  Eigen::VectorXd c(size_);
  rail_.restrict_to(r.rail, c.data());
  wheel_.restrict_to(r.wheel, c.data() + rail_.modes());
  c[size_ - 1] = r.axle;
  const Eigen::VectorXd coarse = coarse_factor_.solve(c);
  rail_.prolong(coarse.data(), z.rail);
  wheel_.prolong(coarse.data() + rail_.modes(), z.wheel);
  z.axle += coarse[size_ - 1];
}

}  // namespace railstrata
