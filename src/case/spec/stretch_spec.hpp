#pragma once
// Stretches of a body in which its materials are stiffer or stronger, in SI units.
#include <array>
#include <optional>
#include <vector>

#include "core/body_id.hpp"

namespace railstrata {

/// Factors at a place along the rail; linear between two of them.
struct StretchPoint {
  double x = 0;  ///< m
  double young = 1, strength = 1;
};
inline std::array<double*, 3> columns(StretchPoint& p) { return {&p.x, &p.young, &p.strength}; }

struct StretchSpec {
  BodyId on = BodyId::rail;
  std::vector<StretchPoint> along;
  std::optional<double> depth;  ///< m, below the running surface; not given: through the body
};

}  // namespace railstrata
