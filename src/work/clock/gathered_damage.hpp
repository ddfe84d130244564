#pragma once
// What gathers in the metal of a rail while wear brings it nearer to the surface: Miner's sums of the ways in which
// rolling ends it, at points by arc length and depth of the unworn rail (damage/metal_damage.hpp).
#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "damage/metal_damage.hpp"

namespace railstrata {

/// By strain that stays, by closed cycles of it, by stress: the last two with what they are short, middle and long by.
struct DamageRates {
  double ductility = 0;
  std::array<double, 3> cycles{}, fatigue{};
};
inline constexpr std::size_t kDamages = 7;
std::array<double, kDamages> numbers_of(const DamageRates& rates);

/// m: metal that has failed less deep below the surface of the day is not called a failure. The skin wears off, its
/// stresses are those of asperities, and what eddy currents find first is 0.1 to 0.5 mm deep.
inline constexpr double kShallowest = 0.1e-3;

/// The largest of a damage, and where.
struct WorstPoint {
  double damage = 0, s = 0, depth = 0;  ///< m, of the unworn rail
};

/// The first failures by zone, by place (surface: kShallowest to 0.2 mm deep at that time) and by damage.
struct DamageKey {
  int zone = 0;
  bool surface = false;
  std::size_t damage = 0;  ///< of numbers_of
  auto operator<=>(const DamageKey&) const = default;
};
struct FirstFailure {
  double traffic = 0, depth = 0, s = 0;  ///< depth below the surface of that time
};

/// What changes of it.
struct Gathered {
  std::vector<double> damage;  ///< (column * points + point) * kDamages + kind
  std::map<DamageKey, FirstFailure> failures;
};

class GatheredDamage {
 public:
  /// s: of columns; feet: of the layers, on the unworn rail; deepest: of the points. m.
  GatheredDamage(std::vector<double> s, std::vector<double> feet, double deepest);

  /// Rates by depth below the surface of the day, of a zone of a column.
  struct ZoneRates {
    int zone = 0;
    std::vector<double> depth;
    std::vector<DamageRates> rates;
    bool ends = false;  ///< nothing below the last depth
  };
  /// What happens in a column while the surface goes down; `since`, `until`: the traffic (of which a failure's lies
  /// between). Points that fail are noted.
  void gather(std::size_t column, const std::vector<ZoneRates>& rates, const SinkingStep& step, double since);

  const Gathered& gathered() const { return now_; }
  /// What was gathered in the same points before.
  void stand(Gathered before) { now_ = std::move(before); }
  /// Of the metal that lies kShallowest or deeper below a surface that has sunk by `removed` [m, of columns].
  WorstPoint worst(std::size_t damage, const std::vector<double>& removed) const;
  /// m, below that surface: so deep has all metal failed from it on, where that is deepest.
  double depth_reached(std::size_t damage, const std::vector<double>& removed) const;
  /// By depth of the unworn rail.
  const std::vector<double>& depths() const { return depth_; }
  double damage(std::size_t column, std::size_t point, std::size_t kind) const {
    return now_.damage[(column * depth_.size() + point) * kDamages + kind];
  }

 private:
  std::vector<double> s_, depth_;
  std::vector<int> zone_;
  Gathered now_;
};

}  // namespace railstrata
