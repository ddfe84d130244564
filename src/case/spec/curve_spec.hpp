#pragma once
// A curve and the bogies that run through it, of which a collective finds its loads (curving/steady_curve.hpp).
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/certainty.hpp"

namespace railstrata {

/// Two wheelsets in a frame. Boxes: stiffness of one, of the four.
struct BogieNumbers {
  double axle_load = 109.1e3;       ///< N
  double wheelbase = 2.56;          ///< m
  double wheelset_mass = 1813;      ///< kg
  double longitudinal = 31.391e6;   ///< N/m, of a box
  double lateral = 3.884e6;         ///< N/m, of a box
  double box_distance = 2;          ///< m, across
  double centre_of_gravity = 1.76;  ///< m, of all above the axles, above the top of rail
  double traction_coefficient = 0;  ///< longitudinal force over the load, positive drives
};

/// A kind of vehicle by name, with how sure its numbers are. The first one is the default.
struct BogieType {
  std::string_view name;
  Certainty certainty = Certainty::absent;
  std::string_view source;
  BogieNumbers numbers;
};
const std::vector<BogieType>& bogie_types();

struct BogieSpec : BogieNumbers {
  std::string name;           ///< empty: that of the type
  int type = 0;               ///< of bogie_types()
  std::optional<double> mgt;  ///< million gross tonnes of such vehicles
  std::optional<double> speed;
  std::string wheel_profile;  ///< as of the geometry; empty: the case's
  std::optional<double> wheel_radius;
  std::string title() const {
    return name.empty() ? std::string(bogie_types().at(static_cast<std::size_t>(type)).name) : name;
  }
};

enum class CurveRail { outer, inner, both };

struct CurveSpec {
  std::optional<double> radius;  ///< m
  double superelevation = 0;     ///< m, of the outer rail
  CurveRail rail = CurveRail::outer;
  std::vector<BogieSpec> bogies;
};

}  // namespace railstrata
