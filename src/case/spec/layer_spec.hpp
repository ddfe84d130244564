#pragma once
// Materials, layers and stretches of a case, in SI units.
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/body_id.hpp"
#include "friction/friction_table.hpp"
#include "spec/strength_spec.hpp"

namespace railstrata {

struct MaterialSpec {
  double young = 210e9, poisson = 0.3, density = 7800.0;
  StrengthSpec strength = {};
};

/// Young's modulus at a depth below a layer's top; linear between two of them.
struct ModulusPoint {
  double depth = 0, young = 0;
  friend bool operator==(const ModulusPoint&, const ModulusPoint&) = default;
};

inline std::array<double*, 2> columns(ModulusPoint& p) { return {&p.depth, &p.young}; }

/// A stretch along the rail where a layer has come off its base, m.
struct UnbondedStretch {
  double from = 0, to = 0;
};

inline std::array<double*, 2> columns(UnbondedStretch& s) { return {&s.from, &s.to}; }

/// m, of a layer's thickness: the range of a case, and from where on finite elements take it.
inline constexpr double kThinnestLayer = 0.01e-3, kThickestLayer = 50e-3, kThinnestMeshedLayer = 0.05e-3;

/// Pa/m, of an interface's springs; a shear stiffness may also be 0.
inline constexpr double kSoftestInterface = 1e10, kStiffestInterface = 1e19;

struct LayerSpec {
  std::string name = "layer";  ///< of several of a body that have none in the file: "layer 1", "layer 2", …
  BodyId on = BodyId::rail;
  double thickness = 1e-3;  ///< of a graded layer: its table's last depth
  double width = 0.060;
  /// Thickness over y of the body's profile [m], in place of thickness, which is then the table's largest or that at a
  /// contact (layers_across), and of width: outside its rows there is no layer. Empty: uniform.
  std::vector<TablePoint> thickness_table;
  MaterialSpec material;                  ///< young of a graded layer: the mean over its depth
  std::vector<ModulusPoint> young_table;  ///< a modulus that varies with depth, from 0 down; empty: uniform
  int elements = 0;                       ///< through the thickness; 0 = chosen
  /// m, along the rail, of the wheel along its arc from the first contact; not given: endless to that side.
  std::optional<double> from, to;
  double taper_length = 0;  ///< m, over which the thickness runs out at these ends, within them; 0: a step
  std::vector<UnbondedStretch> unbonded;  ///< in order, apart from each other; empty: bonded all along
  double unbonded_friction = 0.3;         ///< Coulomb's coefficient on the interface there
  /// Pa/m, of the springs of its lower interface along its normal and in shear; not given: bonded in this direction.
  std::optional<double> interface_normal_stiffness, interface_shear_stiffness;
  /// Pa, and of its pressure: shear at which it slides, the two together; neither given: at none.
  std::optional<double> interface_shear_limit, interface_friction;
  bool graded() const { return !young_table.empty(); }
  bool varies_across() const { return !thickness_table.empty(); }
  /// m, y of the body's profile where the layer ends.
  double low() const { return varies_across() ? thickness_table.front().at : -0.5 * width; }
  double high() const { return varies_across() ? thickness_table.back().at : 0.5 * width; }
  double thickness_at(double y) const {
    if (!varies_across()) return thickness;
    return y < low() || y > high() ? 0 : over_table(thickness_table, y);
  }
  bool ends() const { return from || to; }
  bool slides() const { return interface_shear_limit || interface_friction; }
  bool changes_along() const { return ends() || !unbonded.empty(); }
  double begin() const { return from.value_or(-std::numeric_limits<double>::infinity()); }
  double end() const { return to.value_or(std::numeric_limits<double>::infinity()); }
};

/// Depth of each layer's top [m]: it lies below those of its body before it that it meets along the rail. Where they
/// have ended, it reaches up into their place.
std::vector<double> layer_tops(const std::vector<LayerSpec>& layers);
/// The layers there are at a place along the rail, endless and as thick as they are there, without their tapers.
std::vector<LayerSpec> layers_at(const std::vector<LayerSpec>& layers, double x);
/// The same layers, with thickness that at this place across each body.
std::vector<LayerSpec> layers_across(std::vector<LayerSpec> layers, double rail_y, double wheel_y);

/// Factors at a place along the rail; linear between two of them.
struct StretchPoint {
  double x = 0;  ///< m
  double young = 1, strength = 1;
};
inline std::array<double*, 3> columns(StretchPoint& p) { return {&p.x, &p.young, &p.strength}; }

/// A stretch of a body in which its materials are stiffer or stronger.
struct StretchSpec {
  BodyId on = BodyId::rail;
  std::vector<StretchPoint> along;
  std::optional<double> depth;  ///< m, below the running surface; not given: through the body
};

}  // namespace railstrata
