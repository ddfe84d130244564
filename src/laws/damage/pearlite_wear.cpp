#include "damage/pearlite_wear.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "damage/hardness.hpp"
#include "damage/positive.hpp"
#include "material/steels.hpp"

namespace railstrata {
namespace {

struct Rail {
  double vickers = 0, wear = 0;
};

/// Softest first.
const std::vector<Rail>& measured_rails() {
  static const std::vector<Rail> all = [] {
    std::vector<Rail> out;
    for (const Steel& s : steels())
      if (s.use == "rail" && s.wear.known())
        out.push_back({vickers_from_brinell(0.5 * (s.hardness.low + s.hardness.high)), s.wear.low});
    std::sort(out.begin(), out.end(), [](const Rail& a, const Rail& b) { return a.vickers < b.vickers; });
    return out;
  }();
  return all;
}

}  // namespace

double pearlite_wear(double vickers) {
  const std::vector<Rail>& rails = measured_rails();
  const double held = std::clamp(positive(vickers, "hardness"), rails.front().vickers, rails.back().vickers);
  std::size_t i = 1;
  while (i + 1 < rails.size() && rails[i].vickers < held) ++i;
  const Rail &a = rails[i - 1], &b = rails[i];
  return a.wear * std::pow(b.wear / a.wear, std::log(held / a.vickers) / std::log(b.vickers / a.vickers));
}

WearHardness pearlite_wear_range() { return {measured_rails().front().vickers, measured_rails().back().vickers}; }

}  // namespace railstrata
