#include "steady/pass_jump.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "material/strain_claim.hpp"
#include "steady/pass_class.hpp"
#include "steady/steady_pass.hpp"

namespace railstrata {

namespace {

constexpr double kSafety = 0.8, kShrinks = 0.25, kGrows = 4;

/// Coefficients of the scheme: Chebyshev's polynomials at w0 and their derivatives.
struct Chebyshev {
  explicit Chebyshev(int s) : w0(1 + 2.0 / 13 / (s * s)), t(s + 1), d(s + 1), dd(s + 1), b(s + 1) {
    t[0] = d[1] = 1;
    t[1] = w0;
    for (int j = 2; j <= s; ++j) {
      t[j] = 2 * w0 * t[j - 1] - t[j - 2];
      d[j] = 2 * t[j - 1] + 2 * w0 * d[j - 1] - d[j - 2];
      dd[j] = 4 * d[j - 1] + 2 * w0 * dd[j - 1] - dd[j - 2];
      b[j] = dd[j] / (d[j] * d[j]);
    }
    b[0] = b[1] = b[2];
    w1 = d[s] / dd[s];
  }
  double a(int j) const { return 1 - b[j] * t[j]; }

  double w0, w1 = 0;
  std::vector<double> t, d, dd, b;
};

}  // namespace

int stages_of(int rounds) { return std::max(2, 1 + static_cast<int>(std::sqrt(1.54 * rounds + 1))); }

std::optional<std::vector<double>> state_after(const std::vector<double>& start, const std::vector<double>& first,
                                               int rounds, const RoundChange& change) {
  const int s = stages_of(rounds);
  const Chebyshev k(s);
  std::vector<double> older = start, newer = start;
  for (std::size_t n = 0; n < start.size(); ++n) newer[n] += k.b[1] * k.w1 * rounds * first[n];
  for (int j = 2; j <= s; ++j) {
    const std::optional<std::vector<double>> rate = change(newer);
    if (!rate) return {};
    const double mu = 2 * k.b[j] * k.w0 / k.b[j - 1], nu = -k.b[j] / k.b[j - 2];
    const double step = 2 * k.b[j] * k.w1 / k.b[j - 1] * rounds, back = -k.a(j - 1) * step;
    for (std::size_t n = 0; n < start.size(); ++n) {
      const double next =
          (1 - mu - nu) * start[n] + mu * newer[n] + nu * older[n] + step * (*rate)[n] + back * first[n];
      older[n] = newer[n];
      newer[n] = next;
    }
  }
  return newer;
}

double jump_error(const std::vector<double>& start, const std::vector<double>& end,
                  const std::vector<double>& rate_at_start, const std::vector<double>& rate_at_end, int rounds) {
  constexpr double kOfTrapezium = 0.8;
  double net = 0, accumulated = 0, net_error = 0, accumulated_error = 0;
  for (std::size_t n = 0; n < start.size(); n += kStreamlineHistory) {
    std::array<double, 7> mean{}, off{};
    for (std::size_t c = 0; c < 7; ++c) {
      mean[c] = (end[n + c] - start[n + c]) / rounds;
      off[c] = kOfTrapezium * (0.5 * (rate_at_start[n + c] + rate_at_end[n + c]) - mean[c]);
    }
    net += std::pow(equivalent_strain(mean.data()), 2);
    net_error += std::pow(equivalent_strain(off.data()), 2);
    accumulated += mean[6] * mean[6];
    accumulated_error += off[6] * off[6];
  }
  const double least = kNoFlow * kNoFlow;
  const double of_net = std::max({net, kClosed * kClosed * accumulated, least});
  return std::sqrt(std::max(net_error / of_net, accumulated_error / std::max(accumulated, least)));
}

int next_jump(int rounds, double error, double tolerance) {
  const double factor = error > 0 ? kSafety * std::sqrt(tolerance / error) : kGrows;
  return static_cast<int>(rounds * std::clamp(factor, kShrinks, kGrows));
}

}  // namespace railstrata
