// What has yielded, as one section for all stations.
#include "body/plastic_section.hpp"

#include <gtest/gtest.h>

#include "body/plastic_field.hpp"
#include "core/faults.hpp"
#include "tests/body/relaxation.hpp"
#include "tests/body/sample_bodies.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

YieldingMaterial hardening() {
  YieldingMaterial m{perfectly_plastic(kSteel, 300e6), {}};
  m.law.modulus[0] = 20e9;
  m.law.recall[0] = 100;
  return m;
}

/// Quadrilateral 2 stays elastic, and `another`.
Body skewed_rail(int another = -1) {
  Body body(distorted_body(SweepKind::extrude), {kSteel}, {});
  body.plastic = PlasticElements(
      body,
      [another](int, int quad, int) {
        return quad == 2 || quad == another ? std::nullopt : std::optional(hardening());
      },
      [](int, int, const Tile&) { return true; });
  return body;
}

/// Strains that are the same at all stations but not over the section, beyond yield; the bubbles at rest.
PlasticHistory yielded(const Body& body) {
  const Field u = nodal_field(body, [](Vec3 x) {
    const double z = x.z - 0.5, y = x.y + 0.1;
    return Vec3{2e-3 * x.x + 0.3 * z * z + 0.1 * y * z, 0.2 * y * z - 1e-3 * y, 0.25 * z * z};
  });
  const PlasticHistory virgin = initial_history(body);
  PlasticHistory history = virgin;
  for (int k = 0; k < 12; ++k) {
    restore_points(body, virgin, history);
    advance_plastic_elements(body, u, 0, history);
  }
  return history;
}

TEST(PlasticSection, OfAStateThatIsTheSameAtAllStationsGivesItBack) {
  const Body body = skewed_rail();
  const PlasticHistory history = yielded(body);
  ASSERT_GT(plastic_extent(body, history).yielded, 500);
  const PlasticSection section = plastic_section(body, history, 0.2, 0.4);
  EXPECT_EQ(section.quads.size(), 19u);
  const PlasticHistory again = history_of_section(body, section);
  ASSERT_EQ(again.places, history.places);
  const PlasticElements& elements = body.plastic;
  const auto kind = [](int entry) {  // mean stress, hourglass forces, bubbles, points
    return entry < 6                          ? std::pair{0, 6}
           : entry < PlasticEntries::kBubbles ? std::pair{6, PlasticEntries::kBubbles}
           : entry < PlasticEntries::kWork    ? std::pair{PlasticEntries::kBubbles, PlasticEntries::kWork}
                                              : std::pair{entry, entry + 1};
  };
  // each against the largest of its kind
  for (int slot = 0; slot < elements.hot_places(history); ++slot)
    for (int entry = 0; entry < elements.entries(); ++entry) {
      if (entry >= PlasticEntries::kTouched && entry < PlasticEntries::kPoints) continue;
      double largest = 0;
      const auto [first, end] = kind(entry);
      for (int other = 0; other < elements.hot_places(history); ++other)
        for (int e = first * kTile; e < end * kTile; ++e)
          largest = std::max(largest, std::abs(elements.rows(history, other)[e]));
      const Tile& tile = body.tiling.tiles[elements.hot(history, slot).tile];
      for (int e = 0; e < tile.end - tile.first; ++e) {
        const std::ptrdiff_t at = entry * kTile + e;
        ASSERT_NEAR(elements.rows(again, slot)[at], elements.rows(history, slot)[at], 1e-6 * largest)
            << "entry " << entry << ", element " << e;
      }
    }
}

TEST(PlasticSection, IsTheMeanOverItsStations) {
  const Body body = skewed_rail();
  PlasticHistory history = initial_history(body);
  double* const rows = body.plastic.rows(history, 0);
  const Stations& stations = body.mesh.blocks[0].stations;
  const int first = 10, end = 14, p = (PlasticEntries::kPoints + 6) * kTile;
  for (int e = first; e < end; ++e) rows[p + e] = 1e-3 * (e - first);  // p of the first pair
  const PlasticSection section = plastic_section(body, history, stations.at[first], stations.at[end]);
  ASSERT_EQ(section.quads[0].quad, body.plastic.hot(history, 0).quad);
  EXPECT_NEAR(section.point(0, 0)[6], 1.5e-3, 1e-15);
  EXPECT_EQ(section.point(0, 1)[6], 0);
}

TEST(PlasticSection, ThatHasYieldedIsRefusedWhereElementsStayElastic) {
  const Body body = skewed_rail(), narrow = skewed_rail(7);
  PlasticSection section = plastic_section(body, yielded(body), 0.2, 0.4);
  EXPECT_THROW(history_of_section(narrow, section), CaseError);
  section.history.assign(section.history.size(), 0.0);
  EXPECT_NO_THROW(history_of_section(narrow, section));
}

}  // namespace
}  // namespace railstrata
