#include "cntc/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/subsurface.hpp"
#include "cntc/discretise.hpp"
#include "cntc/results.hpp"
#include "halfspace/interior.hpp"
#include "material/elastic.hpp"

namespace railstrata::cntc {
namespace {

constexpr int kMostBlocks = 10, kMostValues = 100000;
constexpr std::size_t kMostPoints = 20'000'000;

bool all_elements(int kind) { return kind == 1 || kind == 5; }
bool regular_elements(int kind) { return kind == 2 || kind == 6; }
bool regular_depths(int kind) { return kind <= 3; }

void require_count(std::span<const double> values, bool three, const char* name) {
  if ((three && values.size() != 3) || values.empty() || values.size() > kMostValues)
    throw Refused(kGrid, fmt::format("a block of points has {} numbers for {}", values.size(), name));
  for (const double v : values)
    if (!std::isfinite(v)) throw Refused(kGrid, fmt::format("a number for {} of a block is not finite", name));
}

/// Numbers that count: of depths, and the increments of columns and rows.
void require_counts(const BlockInput& in) {
  const auto counts = [](double value) { return value >= 1 && value <= kMostValues; };
  if (regular_depths(in.kind) && !counts(in.z[0]))
    throw Refused(kGrid, fmt::format("NZ = {:g} is no number of depths", in.z[0]));
  if (regular_elements(in.kind) && !(counts(in.x[1]) && counts(in.y[1])))
    throw Refused(kGrid,
                  fmt::format("increments of columns and rows are 1 or more, not {:g} and {:g}", in.x[1], in.y[1]));
}

std::vector<double> depths(const BlockInput& in, double length) {
  std::vector<double> out;
  if (regular_depths(in.kind)) {
    for (int k = 0; k < static_cast<int>(std::lround(in.z[0])); ++k) out.push_back((in.z[1] + k * in.z[2]) * length);
  } else {
    for (const double z : in.z) out.push_back(z * length);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Along x or y, ascending: places of ISUBS = 9, in m, or numbers of columns or rows.
std::vector<double> along(const BlockInput& in, std::span<const double> values, double length) {
  if (all_elements(in.kind)) return {};
  std::vector<double> out(values.begin(), values.end());
  if (in.kind == 9)
    for (double& v : out) v *= length;
  if (!regular_elements(in.kind)) std::sort(out.begin(), out.end());
  return out;
}

/// The places of a block along one direction of a grid: centres of the elements that are chosen.
std::vector<double> places(int kind, const std::vector<double>& given, int count, double first, double step) {
  if (kind == 9) return given;
  std::vector<double> out;
  const auto add = [&](int number) {
    if (number >= 1 && number <= count) out.push_back(first + (number - 1) * step);
  };
  if (all_elements(kind)) {
    for (int k = 1; k <= count; ++k) add(k);
  } else if (regular_elements(kind)) {
    const int low = std::max(1, static_cast<int>(std::lround(given[0])));
    const int by = std::max(1, static_cast<int>(std::lround(given[1])));
    const int high = static_cast<int>(std::lround(std::min(given[2], double{kMostValues})));
    for (int k = low; k <= std::min(high, count); k += by) add(k);
  } else {
    int last = 0;
    for (const double v : given) {
      const int number = static_cast<int>(std::lround(std::clamp(v, -1.0, double{kMostValues})));
      if (number != last) add(number);
      last = number;
    }
  }
  return out;
}

struct Points {
  std::vector<double> x, y, z;
  std::size_t count() const { return x.size() * y.size() * z.size(); }
};

Points points_of(const Block& b, const PatchGrid& g) {
  return {places(b.kind, b.x, g.nx, g.x0, g.dx), places(b.kind, b.y, g.ny, g.y0, g.dy), b.z};
}

/// Displacement and stress of a point of a body in its own axes: z into it.
class Interior {
 public:
  /// upper: body 1.
  Interior(const Solved& s, bool upper) : grid_(s.on.grid), body_(upper ? s.upper : s.lower) {
    const double sign = upper ? -1 : 1;
    const TangentialSolution& t = s.rolling.tangential;
    p_ = s.rolling.normal.pressure;
    q_x_ = t.q_x;
    q_y_ = t.q_y;
    scale_by(q_x_, sign);
    scale_by(q_y_, sign);
    if (!body_.layers.empty()) layered_ = std::make_unique<Subsurface>(body_, grid_, p_, q_x_, q_y_);
  }

  /// centred: the points are at centres of elements; those of a depth follow each other.
  std::vector<InteriorPoint> at(const std::vector<Vec3>& points, bool centred) const {
    if (layered_) return layered_->at(points);
    std::vector<InteriorPoint> out(points.size());
    std::size_t begin = 0;
    while (begin < points.size()) {
      std::size_t end = begin + 1;
      while (end < points.size() && points[end].z == points[begin].z) ++end;
      const Offsets table = centred && end - begin > kWorthTable ? offsets(points[begin].z) : Offsets{};
      for_each_if((end - begin) * grid_.size() > kWorthThreads, static_cast<std::ptrdiff_t>(end - begin), [&](int k) {
        const std::size_t at = begin + static_cast<std::size_t>(k);
        out[at] = table.empty() ? sum_at(points[at]) : sum_at(points[at], table);
      });
      begin = end;
    }
    return out;
  }

 private:
  static constexpr std::size_t kWorthThreads = 100000, kWorthTable = 20;

  /// Influences of one element at the distances from centre to centre, at one depth.
  struct Influence {
    InteriorInfluence state;
    InteriorDisplacement displacement;
  };
  using Offsets = std::vector<Influence>;

  Influence influence(double x, double y, double z) const {
    return {rectangle_interior(body_.substrate, x, y, z, grid_.dx, grid_.dy),
            rectangle_displacement(body_.substrate, x, y, z, grid_.dx, grid_.dy)};
  }

  std::size_t offset(int i, int j) const {
    return static_cast<std::size_t>(i + grid_.nx - 1) * static_cast<std::size_t>(2 * grid_.ny - 1) +
           static_cast<std::size_t>(j + grid_.ny - 1);
  }

  Offsets offsets(double z) const {
    Offsets out;
    for (int i = 1 - grid_.nx; i < grid_.nx; ++i)
      for (int j = 1 - grid_.ny; j < grid_.ny; ++j) out.push_back(influence(i * grid_.dx, j * grid_.dy, z));
    return out;
  }

  InteriorPoint sum_at(const Vec3& at) const {
    return sum_of_cells([&](int i, int j) { return influence(at.x - grid_.x(i), at.y - grid_.y(j), at.z); });
  }

  InteriorPoint sum_at(const Vec3& at, const Offsets& table) const {
    const int column = static_cast<int>(std::lround((at.x - grid_.x0) / grid_.dx));
    const int row = static_cast<int>(std::lround((at.y - grid_.y0) / grid_.dy));
    return sum_of_cells([&](int i, int j) -> const Influence& { return table[offset(column - i, row - j)]; });
  }

  template <class Of>
  InteriorPoint sum_of_cells(const Of& of) const {
    InteriorPoint out;
    InteriorState sum;
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j) {
        const std::size_t k = grid_.index(i, j);
        if (!(p_[k] > 0)) continue;
        const double load[] = {p_[k], q_x_[k], q_y_[k]};
        const Influence& from = of(i, j);
        for (std::size_t c = 0; c < 3; ++c) add(load[c], from.state[c], from.displacement[c], sum, out.displacement);
      }
    out.stress = stress_of(sum, body_.substrate);
    return out;
  }

  static void add(double load, const InteriorState& state, const Vec3& u, InteriorState& sum, Vec3& displacement) {
    sum.e_xx += load * state.e_xx;
    sum.e_yy += load * state.e_yy;
    sum.e_xy += load * state.e_xy;
    sum.s_xz += load * state.s_xz;
    sum.s_yz += load * state.s_yz;
    sum.s_zz += load * state.s_zz;
    displacement += load * u;
  }

  PatchGrid grid_;
  LayeredHalfSpace body_;
  Plane p_, q_x_, q_y_;
  std::unique_ptr<Subsurface> layered_;
};

/// One row of the table, SI, in the axes of the problem: z into body 1.
std::array<double, kBlockColumns> row_of(const Vec3& at, const InteriorPoint& p, bool upper) {
  const double up = upper ? 1 : -1;
  const Sym3& s = p.stress;
  const double xz = up * s.xz, yz = up * s.yz;
  const Vec3 principal = principal_stresses(s);
  return {at.x,
          at.y,
          at.z,
          p.displacement.x,
          p.displacement.y,
          up * p.displacement.z,
          (s.xx + s.yy + s.zz) / 3,
          von_mises(s),
          principal.x - principal.z,
          principal.x,
          principal.y,
          principal.z,
          s.xx,
          s.xy,
          xz,
          s.xy,
          s.yy,
          yz,
          xz,
          yz,
          s.zz};
}

/// The points of one body, z ascending; their rows begin at `first`.
void fill(const Solved& s, const Points& points, bool upper, Block& out) {
  std::vector<Vec3> inside;
  std::vector<std::size_t> rows;
  const std::size_t nx = points.x.size(), ny = points.y.size(), n = points.count();
  for (std::size_t r = 0; r < n; ++r) {
    const double z = points.z[r / (nx * ny)];
    if ((z >= 0) != upper) continue;
    inside.push_back({points.x[r % nx], points.y[r / nx % ny], std::abs(z)});
    rows.push_back(r);
  }
  if (inside.empty()) return;
  const std::vector<InteriorPoint> found = Interior(s, upper).at(inside, out.kind != 9);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Vec3 at{inside[k].x, inside[k].y, upper ? inside[k].z : -inside[k].z};
    const auto row = row_of(at, found[k], upper);
    for (std::size_t c = 0; c < row.size(); ++c) out.table[c * n + rows[k]] = row[c];
  }
}

}  // namespace

void add_block(Problem& p, const BlockInput& in) {
  const int most = std::min(kMostBlocks, static_cast<int>(p.blocks.size()) + 1);
  if (in.number < 0 || in.number > most)
    throw Refused(kGrid,
                  fmt::format("block {}: the next is {}, and there are at most {}", in.number, most, kMostBlocks));
  p.blocks.resize(static_cast<std::size_t>(std::max(0, in.number - 1)));
  if (in.number == 0) return;
  if (in.kind < 1 || in.kind > 9 || in.kind == 4 || in.kind == 8)
    throw Refused(kGrid, fmt::format("ISUBS = {} does not exist: 1, 2, 3, 5, 6, 7 and 9 do", in.kind));
  if (!all_elements(in.kind)) {
    require_count(in.x, regular_elements(in.kind), "x");
    require_count(in.y, regular_elements(in.kind), "y");
  }
  require_count(in.z, regular_depths(in.kind), "z");
  require_counts(in);
  Block block;
  block.kind = in.kind;
  block.x = along(in, in.x, p.units.length);
  block.y = along(in, in.y, p.units.length);
  block.z = depths(in, p.units.length);
  p.blocks.push_back(std::move(block));
}

void solve_blocks(Problem& p) {
  const Solved& s = solution(p);
  if (!s.late[0].empty()) throw Refused(kOther, "stresses in viscoelastic bodies (M = 1) are not offered");
  for (Block& b : p.blocks) {
    const Points points = points_of(b, s.on.grid);
    if (points.count() > kMostPoints) throw Refused(kGrid, "a block has more than 20 million points");
    b.size = {static_cast<int>(points.x.size()), static_cast<int>(points.y.size()), static_cast<int>(points.z.size())};
    b.table.assign(kBlockColumns * points.count(), 0.0);
    fill(s, points, true, b);
    fill(s, points, false, b);
  }
}

std::array<int, 3> block_size(const Problem& p, int number) {
  if (number < 1 || number > static_cast<int>(p.blocks.size())) return {-1, -1, -1};
  const Block& b = p.blocks[static_cast<std::size_t>(number - 1)];
  if (!b.table.empty()) return b.size;
  const Points points = points_of(b, p.solved ? p.solved->on.grid : discretise(p.settings).grid);
  return {static_cast<int>(points.x.size()), static_cast<int>(points.y.size()), static_cast<int>(points.z.size())};
}

std::vector<double> block_column(const Problem& p, int number, int column) {
  if (number < 1 || number > static_cast<int>(p.blocks.size()))
    throw Refused(kGrid, fmt::format("there is no block {}", number));
  const Block& b = p.blocks[static_cast<std::size_t>(number - 1)];
  if (b.table.empty())
    throw Refused(kOther, fmt::format("block {} has no results: subs_calculate comes first", number));
  if (column < 1 || column > kBlockColumns)
    throw Refused(kOther, fmt::format("blocks have columns 1 to {}, not {}", kBlockColumns, column));
  const std::size_t n = b.table.size() / kBlockColumns;
  const auto from = b.table.begin() + static_cast<std::ptrdiff_t>(n * static_cast<std::size_t>(column - 1));
  std::vector<double> out(from, from + static_cast<std::ptrdiff_t>(n));
  const double unit = column <= 6 ? 1 / p.units.length : p.units.area();
  for (double& v : out) v *= unit;
  return out;
}

}  // namespace railstrata::cntc
