#include "calibrate/calibrate.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>

namespace railstrata {
namespace {

constexpr double kWorthATerm = 0.75, kExact = 1e-4;     // by what a further backstress lowers the error; none needed
constexpr int kPerDecade = 4;                           // of γ
constexpr double kFirstStep = 1.4, kLastStep = 1.0005;  // factors by which γ is moved
constexpr double kMostOfYield = 0.95;  // of the settled yield stress, what isotropic hardening may have added
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The stress of one backstress of γ over C/γ at a measured point.
using Basis = std::function<double(double recall, const CurvePoint&)>;

/// Non-negative least squares of the relative stress: σ_y0, then C/γ of each γ. Least over all sets of columns whose
/// plain least squares are non-negative: a handful of columns.
struct LinearFit {
  double residual = kInfinity;  ///< sum of squares
  std::vector<double> shares;   ///< σ_y0, C_i/γ_i
};

class Fitter {
 public:
  Fitter(const std::vector<CurvePoint>& points, Basis basis) : points_(points), basis_(std::move(basis)) {}

  LinearFit at(const std::vector<double>& recalls) const {
    const auto rows = static_cast<Eigen::Index>(points_.size());
    const auto width = static_cast<Eigen::Index>(recalls.size()) + 1;
    Eigen::MatrixXd a(rows, width);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const CurvePoint& point = points_[static_cast<std::size_t>(r)];
      const double weight = 1 / std::max(std::abs(point.stress), 0.1 * largest());
      a(r, 0) = weight;
      for (Eigen::Index c = 1; c < width; ++c)
        a(r, c) = weight * basis_(recalls[static_cast<std::size_t>(c - 1)], point);
    }
    Eigen::VectorXd b(rows);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const double stress = points_[static_cast<std::size_t>(r)].stress;
      b[r] = stress / std::max(std::abs(stress), 0.1 * largest());
    }
    return best_columns(a, b);
  }

  HardeningFit fit(std::vector<double> recalls) const {
    HardeningFit out;
    const LinearFit linear = at(recalls);
    if (!(linear.residual < kInfinity)) throw std::invalid_argument("no yield stress above zero fits the points");
    out.law.yield = linear.shares[0];
    for (std::size_t k = 0; k < recalls.size(); ++k) {
      if (linear.shares[k + 1] <= 0) continue;
      out.law.modulus[out.backstresses] = linear.shares[k + 1] * recalls[k];
      out.law.recall[out.backstresses++] = recalls[k];
    }
    double squares = 0;
    for (const CurvePoint& point : points_) {
      double stress = linear.shares[0];
      for (std::size_t k = 0; k < recalls.size(); ++k) stress += linear.shares[k + 1] * basis_(recalls[k], point);
      const double error = std::abs(stress - point.stress) / largest();
      squares += error * error;
      out.largest_error = std::max(out.largest_error, error);
    }
    out.error = std::sqrt(squares / static_cast<double>(points_.size()));
    return out;
  }

  /// The best set of so many γ from a grid, then moved.
  std::vector<double> search(const std::vector<double>& grid, int count) const {
    std::vector<double> best, chosen;
    double least = kInfinity;
    const std::function<void(std::size_t)> choose = [&](std::size_t from) {
      if (static_cast<int>(chosen.size()) == count) {
        if (const double residual = at(chosen).residual; residual < least) {
          least = residual;
          best = chosen;
        }
        return;
      }
      for (std::size_t i = from; i < grid.size(); ++i) {
        chosen.push_back(grid[i]);
        choose(i + 1);
        chosen.pop_back();
      }
    };
    choose(0);
    return refined(best, least, grid.back(), grid.front());
  }

 private:
  double largest() const {
    double out = 0;
    for (const CurvePoint& point : points_) out = std::max(out, std::abs(point.stress));
    return out;
  }

  static LinearFit best_columns(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    LinearFit best;
    const Eigen::Index width = a.cols();
    for (int kept = 1; kept < 1 << width; kept += 2) {  // the first column, the yield stress, always
      std::vector<Eigen::Index> columns;
      for (Eigen::Index c = 0; c < width; ++c)
        if (kept >> c & 1) columns.push_back(c);
      Eigen::MatrixXd part(a.rows(), static_cast<Eigen::Index>(columns.size()));
      for (std::size_t c = 0; c < columns.size(); ++c) part.col(static_cast<Eigen::Index>(c)) = a.col(columns[c]);
      const Eigen::VectorXd x = part.colPivHouseholderQr().solve(b);
      if (!(x[0] > 0) || x.minCoeff() < 0) continue;
      const double residual = (part * x - b).squaredNorm();
      if (!(residual < best.residual)) continue;
      best.residual = residual;
      best.shares.assign(static_cast<std::size_t>(width), 0.0);
      for (std::size_t c = 0; c < columns.size(); ++c)
        best.shares[static_cast<std::size_t>(columns[c])] = x[static_cast<Eigen::Index>(c)];
    }
    return best;
  }

  /// One γ after the other up and down by a factor that shrinks.
  std::vector<double> refined(std::vector<double> recalls, double least, double highest, double lowest) const {
    for (double factor = kFirstStep; factor > kLastStep;) {
      bool moved = false;
      for (double& recall : recalls)
        for (const double by : {factor, 1 / factor}) {
          const double before = recall;
          recall = std::clamp(before * by, lowest, highest);
          if (const double residual = at(recalls).residual; residual < least) {
            least = residual;
            moved = true;
          } else {
            recall = before;
          }
        }
      if (!moved) factor = std::sqrt(factor);
    }
    return recalls;
  }

  const std::vector<CurvePoint>& points_;
  Basis basis_;
};

std::vector<double> grid_of(double smallest_strain, double largest_strain) {
  const double low = 0.1 / largest_strain, high = 2 / smallest_strain;
  const int count = std::clamp(static_cast<int>(std::ceil(kPerDecade * std::log10(high / low))), 4, 12);
  std::vector<double> out;
  for (int i = 0; i <= count; ++i) out.push_back(low * std::pow(high / low, static_cast<double>(i) / count));
  return out;
}

void require_points(std::size_t different, int backstresses) {
  if (static_cast<int>(different) <= 2 * backstresses) throw std::invalid_argument("fewer points than numbers sought");
}

HardeningFit search_fit(const std::vector<CurvePoint>& points, const std::vector<double>& strains, const Basis& basis,
                        int backstresses) {
  const std::set<double> different(strains.begin(), strains.end());
  if (different.empty() || !(*different.begin() > 0)) throw std::invalid_argument("plastic strains must be positive");
  const std::vector<double> grid = grid_of(*different.begin(), *different.rbegin());
  const Fitter fitter(points, basis);
  const int first = backstresses > 0 ? backstresses : 1, last = backstresses > 0 ? backstresses : kMostBackstresses;
  require_points(different.size(), first);
  HardeningFit best = fitter.fit(fitter.search(grid, first));
  for (int count = first + 1; count <= last && static_cast<int>(different.size()) > 2 * count; ++count) {
    const HardeningFit more = fitter.fit(fitter.search(grid, count));
    if (best.error < kExact || more.error > kWorthATerm * best.error) break;
    best = more;
  }
  return best;
}

/// Over the largest measured stress.
struct Errors {
  double root_mean_square = 0, largest = 0;
};
Errors errors(const PlasticParameters<double>& p, const std::vector<CurvePoint>& monotonic) {
  double highest = 0, squares = 0;
  Errors out;
  for (const CurvePoint& point : monotonic) highest = std::max(highest, std::abs(point.stress));
  for (const CurvePoint& point : monotonic) {
    const double error = std::abs(monotonic_stress(p, point.plastic_strain) - point.stress) / highest;
    squares += error * error;
    out.largest = std::max(out.largest, error);
  }
  out.root_mean_square = std::sqrt(squares / static_cast<double>(monotonic.size()));
  return out;
}

double amplitude_basis(double recall, const CurvePoint& point) { return std::tanh(recall * point.plastic_strain); }

}  // namespace

HardeningFit fit_amplitudes(const std::vector<CurvePoint>& points, int backstresses) {
  std::vector<double> strains;
  for (const CurvePoint& point : points) strains.push_back(point.plastic_strain);
  return search_fit(points, strains, amplitude_basis, backstresses);
}

HardeningFit fit_amplitudes(const std::vector<CurvePoint>& points, const std::vector<double>& recalls) {
  return Fitter(points, amplitude_basis).fit(recalls);
}

namespace {

/// Around a loop in the sense of the test work is dissipated: ∮ σ dε_p > 0.
bool runs_backwards(const std::vector<CurvePoint>& loop) {
  double work = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const CurvePoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    work += 0.5 * (a.stress + b.stress) * (b.plastic_strain - a.plastic_strain);
  }
  return work < 0;
}

/// Throws std::invalid_argument where one step makes most of a branch: there are no points of it.
void require_both_branches(double longest_rising, double longest_falling, double width) {
  constexpr double kMostOfIt = 0.6;
  const bool up = longest_rising < kMostOfIt * width, down = longest_falling < kMostOfIt * width;
  if (up && down) return;
  throw std::invalid_argument(up     ? "the points go up only: give both branches of the loop"
                              : down ? "the points go down only: give both branches of the loop"
                                     : "a single step makes most of a branch: give points all around the loop");
}

}  // namespace

Loop loop_of(const std::vector<CurvePoint>& given) {
  constexpr double kNarrowest = 1e-4, kElastic = 0.02, kBackwards = 0.05;  // plastic width; shares of it
  constexpr std::size_t kFewest = 10;
  std::vector<CurvePoint> measured = given;
  if (runs_backwards(measured)) std::reverse(measured.begin(), measured.end());
  if (measured.size() < kFewest) throw std::invalid_argument("a loop needs ten points at least");
  const auto by_stress = [](const CurvePoint& a, const CurvePoint& b) { return a.stress < b.stress; };
  const auto [low, high] = std::minmax_element(measured.begin(), measured.end(), by_stress);
  const double width = high->plastic_strain - low->plastic_strain;
  if (!(width > kNarrowest))
    throw std::invalid_argument("the loop has no plastic width: its tips are less than 0.01 % of plastic strain apart");
  const CurvePoint middle{0.5 * (high->plastic_strain + low->plastic_strain), 0.5 * (high->stress + low->stress)};
  Loop out{0.5 * width, {}};
  const auto n = measured.size(), bottom = static_cast<std::size_t>(low - measured.begin()),
             top = static_cast<std::size_t>(high - measured.begin());
  double longest[2] = {0, 0};
  for (const bool rising : {true, false}) {
    const std::size_t from = rising ? bottom : top, to = rising ? top : bottom;
    double reached = -out.amplitude;
    for (std::size_t i = from;; i = (i + 1) % n) {
      const double sign = rising ? 1 : -1;
      const CurvePoint p{sign * (measured[i].plastic_strain - middle.plastic_strain),
                         sign * (measured[i].stress - middle.stress)};
      if (p.plastic_strain < reached - kBackwards * width)
        throw std::invalid_argument("the points do not go once up and once down: keep one loop, in the order measured");
      longest[rising ? 0 : 1] = std::max(longest[rising ? 0 : 1], p.plastic_strain - reached);
      reached = std::max(reached, p.plastic_strain);
      if (p.plastic_strain + out.amplitude > kElastic * width) out.points.push_back(p);
      if (i == to) break;
    }
  }
  require_both_branches(longest[0], longest[1], width);
  return out;
}

HardeningFit fit_loop(const Loop& loop, int backstresses) {
  std::vector<double> strains;  // from the reversal
  for (const CurvePoint& point : loop.points) strains.push_back(point.plastic_strain + loop.amplitude);
  const double amplitude = loop.amplitude;
  const Basis basis = [amplitude](double recall, const CurvePoint& point) {
    return 1 - (1 + std::tanh(recall * amplitude)) * std::exp(-recall * (point.plastic_strain + amplitude));
  };
  return search_fit(loop.points, strains, basis, backstresses);
}

RateBounds rate_bounds(const std::vector<CurvePoint>& monotonic) {
  double smallest = kInfinity, longest = 0;
  for (const CurvePoint& point : monotonic) {
    smallest = std::min(smallest, point.plastic_strain);
    longest = std::max(longest, point.plastic_strain);
  }
  return {0.1 / longest, 3 / smallest};
}

HardeningFit with_isotropic_part(HardeningFit stabilised, const std::vector<CurvePoint>& monotonic) {
  if (monotonic.size() < 3) throw std::invalid_argument("fewer points than numbers sought");
  const RateBounds bounds = rate_bounds(monotonic);
  if (std::any_of(monotonic.begin(), monotonic.end(), [](const CurvePoint& p) { return !(p.plastic_strain > 0); }))
    throw std::invalid_argument("plastic strains must be positive");
  const PlasticParameters<double> settled = stabilised.law;
  const auto law = [&](double q, double b) {
    PlasticParameters<double> p = settled;
    p.yield = settled.yield - q;
    p.saturation = q;
    p.rate = b;
    return p;
  };
  Errors least = errors(settled, monotonic);
  for (double b = bounds.low; b < bounds.high; b *= 1.02) {
    double above = 0, below = 0;  // Q of this b: sum of (excess of the settled law)(e^{-b p}) over that of e^{-2 b p}
    for (const CurvePoint& point : monotonic) {
      const double share = std::exp(-b * point.plastic_strain);
      above += share * (monotonic_stress(settled, point.plastic_strain) - point.stress);
      below += share * share;
    }
    const PlasticParameters<double> tried = law(std::min(above / below, kMostOfYield * settled.yield), b);
    if (const Errors e = errors(tried, monotonic); e.root_mean_square < least.root_mean_square) {
      least = e;
      stabilised.law = tried;
    }
  }
  stabilised.error = least.root_mean_square;
  stabilised.largest_error = least.largest;
  return stabilised;
}

HardeningFit fit_yield_stresses(const std::vector<CurvePoint>& points) {
  std::vector<CurvePoint> strained = points;
  std::erase_if(strained, [](const CurvePoint& p) { return !(p.plastic_strain > 0); });
  std::set<double> strains;
  for (const CurvePoint& point : points) strains.insert(point.plastic_strain);
  if (points.size() < 4 || strains.size() < 3) throw std::invalid_argument("fewer points than numbers sought");
  const auto count = static_cast<double>(points.size());
  const RateBounds bounds = rate_bounds(strained);
  HardeningFit out;
  out.error = kInfinity;
  for (double b = bounds.low; b < bounds.high; b *= 1.02) {
    double mean_share = 0, mean_stress = 0, product = 0, square = 0;
    for (const CurvePoint& point : points) {
      mean_share += std::exp(-b * point.plastic_strain) / count;
      mean_stress += point.stress / count;
    }
    for (const CurvePoint& point : points) {
      const double share = std::exp(-b * point.plastic_strain) - mean_share;
      product += share * (point.stress - mean_stress);
      square += share * share;
    }
    const double saturation = -product / square;
    const PlasticParameters<double> tried{0, mean_stress - saturation * (1 - mean_share), saturation, b, {}, {}};
    if (!(tried.yield > 0) || !(tried.yield + tried.saturation > 0)) continue;
    if (const Errors e = errors(tried, points); e.root_mean_square < out.error)
      out = {tried, 0, e.root_mean_square, e.largest};
  }
  if (!(out.error < kInfinity)) throw std::invalid_argument("no yield stress above zero fits the points");
  return out;
}

double amplitude_of(const PlasticParameters<double>& p, double plastic_amplitude) {
  double out = p.yield + p.saturation;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (p.modulus[k] > 0)
      out += p.recall[k] > 0 ? p.modulus[k] / p.recall[k] * std::tanh(p.recall[k] * plastic_amplitude)
                             : p.modulus[k] * plastic_amplitude;
  return out;
}

double loop_stress(const PlasticParameters<double>& p, double plastic_amplitude, double plastic_strain) {
  double out = p.yield + p.saturation;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (p.modulus[k] > 0)
      out += p.recall[k] > 0 ? p.modulus[k] / p.recall[k] *
                                   (1 - (1 + std::tanh(p.recall[k] * plastic_amplitude)) *
                                            std::exp(-p.recall[k] * (plastic_strain + plastic_amplitude)))
                             : p.modulus[k] * plastic_strain;
  return out;
}

double monotonic_stress(const PlasticParameters<double>& p, double plastic_strain) {
  double out = p.yield + p.saturation * saturated_share(p.rate * plastic_strain);
  for (int k = 0; k < kMostBackstresses; ++k)
    if (p.modulus[k] > 0)
      out += p.recall[k] > 0 ? p.modulus[k] / p.recall[k] * saturated_share(p.recall[k] * plastic_strain)
                             : p.modulus[k] * plastic_strain;
  return out;
}

}  // namespace railstrata
