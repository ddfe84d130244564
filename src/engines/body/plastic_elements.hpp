#pragma once
// The elements of a body that may yield: which they are, what they read and where their numbers stand.
//
// An element that may yield is the elastic one with an eigenstress (element/plastic_hex.hpp). Before the forces of a
// step a pass over these elements alone carries the plastic strains at their Gauss points on and writes the 18 numbers
// that the traversal then takes off; all others stay as they are.
//
// A *place* is what one tile has of the elements of one quadrilateral. All places of a material that yields are
// candidates; those that are *hot* keep numbers in the body's history, the others cost nothing and are elastic. Places
// become hot while a run goes on (extend_plastic_elements, body/plastic_pass.hpp) and stay hot. Which are is part of
// the history, so that whatever carries a state carries it. Within hot places groups of
// eight elements sleep while they are far from yielding.
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "body/element_tables.hpp"
#include "body/tiling.hpp"
#include "element/reference.hpp"
#include "material/plastic.hpp"

namespace railstrata {

struct Body;

/// History of the elements of a body that may yield: a slot of numbers for each place that is hot, in the order in
/// which the places became hot.
struct PlasticHistory {
  static constexpr int kCold = -1;

  std::vector<int> places;   ///< candidate of each slot
  std::vector<int> slot_of;  ///< of each candidate, or kCold; follows from `places`
  Field numbers;             ///< slot by slot: entry k of a place's elements at + k * kTile

  friend bool operator==(const PlasticHistory&, const PlasticHistory&) = default;
};

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
  static constexpr int kTouched = kBubbles + 9;         ///< of a group, at its first element: 0: never yielded
  static constexpr int kStressed = kTouched + 1;        ///< of a place, at its first element: 0: no eigenstress
  static constexpr int kWork = kStressed + 1;           ///< plastic work [J/m³], mean of the element
  static constexpr int kAwake = kWork + 1;              ///< of a group, at its first element
  static constexpr int kPoints = kAwake + 1;            ///< histories of the pairs of Gauss points
};

class PlasticElements {
 public:
  /// How a quadrilateral's elements of a material (of the body's) yield; none where they stay elastic.
  using MaterialOf = std::function<std::optional<YieldingMaterial>(int block, int quad, int material)>;
  using Wanted = std::function<bool(int block, int quad, const Tile& tile)>;

  /// None.
  PlasticElements() = default;
  /// wanted: hot from the start. Throws CaseError if the elements are one_point.
  PlasticElements(const Body& body, const MaterialOf& material_of, const Wanted& wanted);

  bool empty() const { return candidates_.empty(); }
  int terms() const { return terms_; }  ///< backstresses, the most of any material
  int point_entries() const { return 7 + 6 * terms_; }
  int entries() const { return PlasticEntries::kPoints + kGaussPairs * point_entries(); }

  /// A tile's elements of one quadrilateral.
  struct Place {
    int tile, quad;
    int kind;       ///< into quads; kMixed: by element
    int some_kind;  ///< of any of its elements that yield
  };
  const std::vector<Place>& candidates() const { return candidates_; }
  bool is_hot(const PlasticHistory& history, int candidate) const {
    return history.slot_of[candidate] != PlasticHistory::kCold;
  }
  /// The numbers of a quadrilateral's elements in a tile, entry k at + k * kTile; null if they are elastic.
  const double* rows(const PlasticHistory& history, int tile, int quad) const {
    if (tile_quads_.empty() || tile_quads_[tile].empty()) return nullptr;
    const int candidate = tile_quads_[tile][quad];
    return candidate < 0 || !is_hot(history, candidate) ? nullptr : rows(history, history.slot_of[candidate]);
  }
  /// The same where the elements have any eigenstress, else null.
  const double* eigenstress(const PlasticHistory& history, int tile, int quad) const {
    const double* const own = rows(history, tile, quad);
    return own && has_eigenstress(own) ? own : nullptr;
  }
  static bool has_eigenstress(const double* rows) { return rows[PlasticEntries::kStressed * kTile] != 0; }

  int hot_places(const PlasticHistory& history) const { return static_cast<int>(history.places.size()); }
  /// In the order in which they became hot.
  const Place& hot(const PlasticHistory& history, int slot) const { return candidates_[history.places[slot]]; }
  /// All that the history has of a hot place: slot_numbers() of them.
  const double* rows(const PlasticHistory& history, int slot) const {
    return history.numbers.data() + slot * slot_numbers();
  }
  double* rows(PlasticHistory& history, int slot) const { return history.numbers.data() + slot * slot_numbers(); }
  std::ptrdiff_t slot_numbers() const { return static_cast<std::ptrdiff_t>(entries()) * kTile; }

  struct Quad {
    GaussShape<double> gauss;
    YieldingMaterial material;
    std::vector<IncompatibleModes<double>> modes;  ///< by hourglass class; those that occur
    int block, quad, of_body;                      ///< of_body: the material's index in the body
  };
  static constexpr int kElastic = -1, kMixed = -2;
  /// For the element at a place: index into quads, or kElastic.
  int kind_at(const Place& p, const Tile& tile, const BlockElements& elements, int element) const {
    return p.kind != kMixed ? p.kind : kinds_[tile.block][elements.reference(elements.set_at(element), p.quad)];
  }
  const Quad& quad(int kind) const { return quads_[kind]; }
  /// Of the candidate of a tile's quadrilateral: the shape is that of all its elements.
  const GaussShape<double>& gauss_at(int tile, int quad) const {
    return quads_[candidates_[tile_quads_[tile][quad]].some_kind].gauss;
  }
  /// Scale of the elements that the hourglass stiffness of a class was made for.
  const SweepScale& scale(int block, int hourglass_class) const { return scales_[block][hourglass_class]; }

  /// That of elements to which nothing has happened.
  PlasticHistory initial_history() const;
  /// A place becomes hot, its elements virgin.
  void add(PlasticHistory& history, int candidate) const;
  /// Whether places and numbers are those of a history of these elements.
  bool fits(const PlasticHistory& history) const;
  /// Completes a history of which places and numbers were read, and fit.
  void index(PlasticHistory& history) const;

 private:
  void add_quads(const Body& body, const MaterialOf& material_of);
  void add_candidates(const Body& body, const Wanted& wanted);
  Place place_of(const Body& body, int tile, int quad) const;

  int terms_ = 0;
  std::vector<Place> candidates_;
  std::vector<int> hot_at_start_;
  std::vector<Quad> quads_;
  std::vector<std::vector<int>> kinds_;       ///< by block; [set * quads + quad]
  std::vector<std::vector<int>> tile_quads_;  ///< candidates
  std::vector<std::vector<SweepScale>> scales_;
};

}  // namespace railstrata
