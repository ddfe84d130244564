#pragma once
// The elements of a body that may yield: which they are, what they read and where their numbers stand.
//
// An element that may yield is the elastic one with an eigenstress (element/plastic_hex.hpp). Before the forces of a
// step a pass over these elements alone carries the plastic strains at their Gauss points on and writes the 18 numbers
// that the traversal then takes off; all others stay as they are. They are chosen by quadrilateral and tile and do not
// change; within them groups of eight elements sleep while they are far from yielding (body/plastic_pass.hpp).
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "body/element_tables.hpp"
#include "body/tiling.hpp"
#include "element/plastic_reference.hpp"
#include "material/plastic.hpp"

namespace railstrata {

struct Body;

/// How elements yield; stress that is in it from the start, in the element's frame (11 along the sweep,
/// 22 lateral, 33 up, 12, 23, 13).
struct YieldingMaterial {
  PlasticParameters<double> law{};
  std::array<double, 6> initial_stress{};  ///< Pa
};

/// Numbers of one element, in this order.
struct PlasticEntries {
  static constexpr int kEigenstress = 0;
  static constexpr int kBubbles = kEigenstressEntries;  ///< alpha_p [m], 3 by bubble
  static constexpr int kWork = kBubbles + 9;            ///< plastic work [J/m³], mean of the element
  static constexpr int kAwake = kWork + 1;              ///< of a group, at its first element
  static constexpr int kPoints = kAwake + 1;  ///< histories of the points: + of pair 0, - of pair 0, + of 1, …
};

class PlasticElements {
 public:
  /// The material of a quadrilateral; none where it stays elastic.
  using MaterialOf = std::function<std::optional<YieldingMaterial>(int block, int quad)>;
  using Wanted = std::function<bool(int block, int quad, const Tile& tile)>;

  /// None.
  PlasticElements() = default;
  /// Throws CaseError if the elements are one_point.
  PlasticElements(const Body& body, const MaterialOf& material_of, const Wanted& wanted);

  bool empty() const { return places_.empty(); }
  int terms() const { return terms_; }  ///< backstresses, the most of any material
  int point_entries() const { return 7 + 6 * terms_; }
  int entries() const { return PlasticEntries::kPoints + 2 * kGaussPairs * point_entries(); }
  std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(places_.size()) * entries() * kTile; }
  /// Where the numbers of a quadrilateral's elements in a tile stand in the body's history, entry k at + k * kTile; -1
  /// if they stay elastic.
  std::ptrdiff_t first(int tile, int quad) const {
    if (tile_quads_.empty() || tile_quads_[tile].empty()) return -1;
    return tile_quads_[tile][quad];
  }

  /// A tile's elements of one quadrilateral.
  struct Place {
    int tile, quad, kind;  ///< kind: into quads()
    std::ptrdiff_t first;
  };
  const std::vector<Place>& places() const { return places_; }
  struct Quad {
    GaussShape<double> gauss;
    YieldingMaterial material;
    std::vector<IncompatibleModes<double>> modes;  ///< by hourglass class; those that occur
  };
  const Quad& quad(const Place& p) const { return quads_[p.kind]; }
  /// Scale of the elements that the hourglass stiffness of a class was made for.
  const SweepScale& scale(int block, int hourglass_class) const { return scales_[block][hourglass_class]; }

  /// Of elements to which nothing has happened.
  void initialise(double* history) const;

 private:
  void add_quads(const Body& body, const MaterialOf& material_of);
  void add_places(const Body& body, const Wanted& wanted);
  void make_modes(const Body& body);

  int terms_ = 0;
  std::vector<Place> places_;
  std::vector<Quad> quads_;
  std::vector<std::array<int, 2>> quad_of_;  ///< block and quadrilateral of quads_
  std::vector<std::vector<std::ptrdiff_t>> tile_quads_;
  std::vector<std::vector<SweepScale>> scales_;
};

}  // namespace railstrata
