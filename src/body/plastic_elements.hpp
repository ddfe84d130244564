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
// the history, so that whatever carries a state carries it:
//
//   history = [directory: a number per candidate, 0 cold, else 1 + its slot, padded][slot 0][slot 1] …
//
// with entries() * kTile numbers in a slot. Within hot places groups of eight elements sleep while they are far from
// yielding.
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
  static constexpr int kTouched = kBubbles + 9;         ///< of a group, at its first element: 0: never yielded
  static constexpr int kWork = kTouched + 1;            ///< plastic work [J/m³], mean of the element
  static constexpr int kAwake = kWork + 1;              ///< of a group, at its first element
  static constexpr int kPoints = kAwake + 1;  ///< histories of the points: + of pair 0, - of pair 0, + of 1, …
  /// Before them all: the candidate that the slot is of, and whether it has any eigenstress.
  static constexpr int kHeader = 8, kCandidate = -kHeader, kStressed = 1 - kHeader;
};

class PlasticElements {
 public:
  /// The material of a quadrilateral; none where it stays elastic.
  using MaterialOf = std::function<std::optional<YieldingMaterial>(int block, int quad)>;
  using Wanted = std::function<bool(int block, int quad, const Tile& tile)>;

  /// None.
  PlasticElements() = default;
  /// wanted: hot from the start. Throws CaseError if the elements are one_point.
  PlasticElements(const Body& body, const MaterialOf& material_of, const Wanted& wanted);

  bool empty() const { return candidates_.empty(); }
  int terms() const { return terms_; }  ///< backstresses, the most of any material
  int point_entries() const { return 7 + 6 * terms_; }
  int entries() const { return PlasticEntries::kPoints + 2 * kGaussPairs * point_entries(); }

  /// A tile's elements of one quadrilateral.
  struct Place {
    int tile, quad, kind;  ///< kind: into quads
  };
  const std::vector<Place>& candidates() const { return candidates_; }
  bool is_hot(const Field& history, int candidate) const { return history[candidate] != 0; }
  /// The eigenstress of a hot place in the body's history, entry k at + k * kTile; null where there is none.
  const double* eigenstress(const Field& history, int tile, int quad) const {
    const std::ptrdiff_t at = first(history, tile, quad);
    if (at < 0) return nullptr;
    const double* const rows = history.data() + at;
    return rows[PlasticEntries::kStressed] != 0 ? rows : nullptr;
  }
  /// Where the numbers of a quadrilateral's elements in a tile stand in the body's history, entry k at + k * kTile; -1
  /// if they are elastic.
  std::ptrdiff_t first(const Field& history, int tile, int quad) const {
    if (tile_quads_.empty() || tile_quads_[tile].empty()) return -1;
    const int candidate = tile_quads_[tile][quad];
    return candidate < 0 || !is_hot(history, candidate) ? -1 : first_of(slot_of(history, candidate));
  }

  /// A hot place.
  struct Hot : Place {
    std::ptrdiff_t first;
  };
  int hot_places(const Field& history) const;
  /// In the order in which they became hot.
  Hot hot(const Field& history, int slot) const;
  /// All that the history has of a hot place: where it begins, and how many numbers.
  std::ptrdiff_t slot_first(int slot) const { return first_of(slot) - PlasticEntries::kHeader; }
  std::ptrdiff_t slot_numbers() const { return slot_size(); }
  /// Elements that are hot.
  long hot_elements(const Body& body, const Field& history) const;

  struct Quad {
    GaussShape<double> gauss;
    YieldingMaterial material;
    std::vector<IncompatibleModes<double>> modes;  ///< by hourglass class; those that occur
  };
  const Quad& quad(const Place& p) const { return quads_[p.kind]; }
  /// Of a candidate.
  const Quad& quad_at(int tile, int quad) const { return quads_[candidates_[tile_quads_[tile][quad]].kind]; }
  /// Scale of the elements that the hourglass stiffness of a class was made for.
  const SweepScale& scale(int block, int hourglass_class) const { return scales_[block][hourglass_class]; }

  /// Adds its part to a body's history: of elements to which nothing has happened.
  void initialise(Field& history) const;
  /// A place becomes hot, its elements virgin.
  void add(Field& history, int candidate) const;
  /// Whether a history is one of these elements, of which there are some.
  bool fits(const Field& history) const;

 private:
  void add_quads(const Body& body, const MaterialOf& material_of);
  void add_candidates(const Body& body, const Wanted& wanted);
  void make_modes(const Body& body);
  std::ptrdiff_t slots_begin() const;
  std::ptrdiff_t slot_size() const;
  std::ptrdiff_t first_of(int slot) const { return slots_begin() + slot * slot_size() + PlasticEntries::kHeader; }
  int slot_of(const Field& history, int candidate) const { return static_cast<int>(history[candidate]) - 1; }
  int candidate_of(const Field& history, int slot) const {
    return static_cast<int>(history[first_of(slot) + PlasticEntries::kCandidate]);
  }

  int terms_ = 0;
  std::vector<Place> candidates_;
  std::vector<int> hot_at_start_;
  std::vector<Quad> quads_;
  std::vector<std::array<int, 2>> quad_of_;   ///< block and quadrilateral of quads_
  std::vector<std::vector<int>> tile_quads_;  ///< candidates
  std::vector<std::vector<SweepScale>> scales_;
};

}  // namespace railstrata
