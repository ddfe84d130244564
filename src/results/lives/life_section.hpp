#pragma once
// What lives of zones look at: a body across, and the sections of its loads at a place and a depth.
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "lives/zone_life.hpp"

namespace railstrata {

inline constexpr std::array kWearLaws{WearLaw::usfd, WearLaw::kth, WearLaw::archard};

/// A body across: positions, what is removed there in a unit of traffic, passages.
struct LifeAcross {
  BodyId body = BodyId::rail;
  std::vector<double> s, y, passages;
  std::array<std::vector<double>, 3> wear;  // m a unit, by laws; empty: no data
  WearLaw law = WearLaw::usfd;
  double ground = 0, every = 0;  // m, units

  Removal removal(std::size_t cell, WearLaw by) const {
    const std::vector<double>& w = wear[static_cast<std::size_t>(by)];
    return {w.empty() || !std::isfinite(w[cell]) ? 0 : w[cell], ground, every};
  }
};
LifeAcross across_rail(const CaseSpec& spec, const RailDamage& d, double tonnes);
LifeAcross across_wheel(const CaseSpec& spec, const WheelDamage& d, double turns);

/// m
double turn_of(const CaseSpec& spec);

/// A section with rows by depth and columns by y, of either kind, and where its y = 0 lies on the profile.
struct LifeSection {
  const std::vector<double>*y, *depth;
  const std::vector<int>* zone;
  double s0 = 0;
};
const SectionShakedown* section_of(const LifeLoad& load, BodyId body);
double middle_of(const LifeLoad& load, BodyId body, std::size_t patch);

/// The two rows of a zone around a depth and the share of the lower one; none: the zone is not in the section.
struct RowsBeside {
  std::size_t above = 0, below = 0;
  double share = 0;
};
std::optional<RowsBeside> rows_beside(const LifeSection& s, int zone, double z);

/// A value of the section at a place of the profile and a depth; 0 outside the section.
double value_at(const LifeSection& s, const std::vector<double>& values, const RowsBeside& rows, double place);

}  // namespace railstrata
