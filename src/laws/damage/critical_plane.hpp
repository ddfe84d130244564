#pragma once
// Critical planes: fatigue parameters of the cycle on the plane where they are largest, by depth.
//
//   Smith-Watson-Topper   <s_n,max> De_n/2                            [SmithWatsonTopper1970]
//   Fatemi-Socie          (Dg/2) (1 + k s_n,max/Y)                    [FatemiSocie1988]
//   Jiang-Sehitoglu       <s_n,max> De_n/2 + J Dg Dt                  [JiangSehitoglu1999]
// On a plane: s_n,max the largest normal stress of the cycle, residual stress included, De_n the range of normal
// strain, Dt that of shear stress, Dg that of engineering shear strain; <s> = s where tension, else 0. The bracket of
// Fatemi-Socie has its sign and is not below 0. Strains are elastic, by Hooke's law from the stress: parameters of a
// rail that shakes down, and a ranking for one that does not. Units: Pa (J/m³), Fatemi-Socie none.
//
// The range of shear is the diameter of the smallest circle around the path of the shear vector on the plane. For a
// straight path it is its length; it is never shorter than the longest chord and at most 2/sqrt(3) of it. The circle
// has one centre, the mean of the cycle, where several chords may be the longest; and it is the safe side of the two.
// [Papadopoulos1998] Elastic shear strain is the shear stress over G, so Dg = Dt/G.
//
// Search: all planes on a grid of 10 degrees; the cells of all that have at least 0.9 of the largest value, at 2.5
// degrees; from the cells that then have at least 0.98 of it, uphill at 1 degree and at 0.2. The largest stress of a
// cycle jumps from one time to another as the plane turns, so the parameter has ridges: 1 degree misses up to 0.5 %
// there, 0.2 degrees 0.1 %.
#include <optional>
#include <span>
#include <vector>

#include "damage/residual_rows.hpp"
#include "damage/stress_history.hpp"

namespace railstrata {

struct FatemiSocieConstants {
  double k = 0;      ///< >= 0; 0.3 to 1 in the literature
  double yield = 0;  ///< Y [Pa], > 0, uniaxial
};

/// Material of a row. Constants that are not given leave their parameter out: they have no default.
struct CriticalPlaneMaterial {
  double young = 0, poisson = 0;  ///< E [Pa]
  std::optional<FatemiSocieConstants> fatemi_socie;
  std::optional<double> jiang_sehitoglu;  ///< J >= 0; 0.1 to 0.3 in the literature
};

/// Stress and strain cycle on one plane.
struct PlaneCycle {
  double normal_max = 0;           ///< Pa, residual stress included
  double normal_strain_range = 0;  ///< De_n
  double shear_range = 0;          ///< Dt [Pa]
};
PlaneCycle plane_cycle(std::span<const Sym3> cycle, const Sym3& residual, const CriticalPlaneMaterial& material,
                       Vec3 normal);

struct CriticalPlane {
  double value = 0;  ///< of the parameter; 0: no plane has more
  int column = -1;
  Vec3 normal;  ///< unit vector, x rolling, y lateral, z into the body; z >= 0
  PlaneCycle cycle;
};

/// The largest parameters of a row.
struct CriticalPlaneRow {
  CriticalPlane smith_watson_topper;
  std::optional<CriticalPlane> fatemi_socie, jiang_sehitoglu;
};

/// Materials by row. Rows in parallel; the bits do not depend on the number of threads. Columns whose bound lies below
/// the largest value found so far in their row are not searched. Throws std::invalid_argument when rows do not fit or a
/// constant is out of its range.
std::vector<CriticalPlaneRow> critical_planes(const StressHistory& history, ResidualRows residual,
                                              std::span<const CriticalPlaneMaterial> materials);

}  // namespace railstrata
