#pragma once
// Strength of a case's materials by depth, and the law by which they yield.
#include <optional>
#include <string>
#include <vector>

#include "damage/strain_life.hpp"
#include "material/material_path.hpp"
#include "material/steels.hpp"
#include "spec/layer_spec.hpp"

namespace railstrata {

/// The value of a table by depth, linear between rows. Throws CaseError below the last row, naming `key`.
double at_depth(const std::vector<DepthPoint>& rows, double depth, const std::string& key);

/// Residual stress of the process at a depth [Pa]: what is given, or a table's, below its last row as
/// there; nothing if the case does not give it.
StressPoint process_stress(const StrengthSpec& strength, double depth, const std::string& key);

/// The strain-life curve of a material: given, with `other` the same, or the two estimates from its tensile strength.
struct StrainLifeOfMaterial {
  StrainLife life, other;
  std::string note;  ///< what it rests on; empty if it was given
};

/// Depths count from the top of the material: of rail and wheel the running surface, of a layer its own top.
class MaterialStrength {
 public:
  /// name: "rail", "wheel", the layer's; key: "material.rail", "layer.0".
  MaterialStrength(const StrengthSpec& strength, std::string name, std::string key);

  /// Pa, uniaxial: a yield strength, a table of them, a grade's, else an estimate from hardness, in this order; NaN
  /// where the case does not give it. Throws CaseError below the end of a table.
  double yield(double depth) const;
  /// Vickers; NaN where the case does not give it.
  double hardness(double depth) const;
  /// Pa, at the top: given, a grade's, else an estimate from hardness, in this order; NaN where the case does not give
  /// it.
  double tensile() const;
  /// Of Dang Van's criterion: given, else of the grade, estimated; a limit of NaN where the case does not give it.
  EstimatedEndurance endurance() const;
  /// m, the depth where the strength's table ends; infinite without one.
  double end() const;
  /// Source of an estimated strength; empty if it was given or is unknown.
  std::string note() const;
  /// Of an estimated endurance, likewise.
  std::string endurance_note() const;

 private:
  StrengthSpec s_;
  std::string name_, key_;
  std::optional<Steel> grade_;
};

/// Nothing where the case gives neither a curve nor a tensile strength that the estimates hold for.
std::optional<StrainLifeOfMaterial> strain_life_of(const MaterialSpec& material, const std::string& name,
                                                   const std::string& key);

/// Whether a case gives a material's strength.
bool has_strength(const StrengthSpec& strength);

/// The set of hardening that a material takes: the one it names, else its grade's where no other key gives a law; empty
/// without one.
std::string_view hardening_name(const StrengthSpec& strength);

/// The law of a material that yields (material/plastic.hpp), with depth:
///   hardening = "…"        a ready set; of known hardness it is scaled by HV(z) over the hardness the set stands for
///                          (that of its tensile strength; of a published set that at the material's top)
///   the two hardening keys the law that is given, which begins at the yield strength; scaled by strength_table or
///                          hardness_table over what it has at the top
///   a strength alone       perfect plasticity
struct PlasticLaw {
  PlasticMaterial top;                     ///< at a factor of 1
  std::vector<DepthPoint> factor;          ///< by depth, linear between; empty: 1 everywhere
  std::vector<std::string> notes;          ///< what is estimated or published, and its source
  PlasticMaterial at(double depth) const;  ///< below the last row as there
};

/// No law where the material is elastic on purpose (elastic = true) or has no strength. Throws CaseError.
std::optional<PlasticLaw> plastic_law(const MaterialSpec& material, const std::string& name, const std::string& key);

}  // namespace railstrata
