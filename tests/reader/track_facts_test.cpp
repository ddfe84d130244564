#include "rules/track_facts.hpp"

#include <gtest/gtest.h>

#include "reader/case_file.hpp"

namespace railstrata {
namespace {

LoadedCase of(const std::string& keys) { return parse_case("[geometry]\n" + keys, "a.toml"); }

bool notes_say(const LoadedCase& loaded, const std::string& words) {
  for (const std::string& note : loaded.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

std::string from_of(const GeometrySpec& g, std::size_t which) { return track_facts(g).at(which).from; }

constexpr const char* kEurope = "wheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\n";

}  // namespace

TEST(TrackFacts, ProfilesBringTheirTrack) {
  const GeometrySpec g = of(kEurope).spec.geometry;
  EXPECT_DOUBLE_EQ(g.back_to_back, 1.360);
  EXPECT_DOUBLE_EQ(g.gauge_depth, 0.014);
  EXPECT_DOUBLE_EQ(g.wheel_radius, 0.460);
  EXPECT_EQ(from_of(g, 0), "EN, of S1002");
  const GeometrySpec china = of("").spec.geometry;
  EXPECT_DOUBLE_EQ(china.back_to_back, 1.353);
  EXPECT_DOUBLE_EQ(china.gauge_depth, 0.016);
  EXPECT_DOUBLE_EQ(china.wheel_radius, 0.430);
}

TEST(TrackFacts, WhatIsGivenWins) {
  const GeometrySpec g = of(std::string(kEurope) + "back_to_back = \"1358 mm\"\ntrack = \"AAR\"\n").spec.geometry;
  EXPECT_DOUBLE_EQ(g.back_to_back, 1.358);
  EXPECT_DOUBLE_EQ(g.gauge_depth, 0.625 * 25.4e-3);
  EXPECT_EQ(from_of(g, 0), "given; AAR has 1349.38 mm");
  EXPECT_EQ(from_of(g, 2), "AAR, by geometry.track");
}

TEST(TrackFacts, ArcsStandOnNoTrackAndKeepTheDefault) {
  const GeometrySpec g = of("wheel_profile = \"arc:R=300 mm\"\nrail_profile = \"UIC60\"\n").spec.geometry;
  EXPECT_DOUBLE_EQ(g.wheel_radius, 0.430);
  EXPECT_EQ(track_facts(g).size(), 2u);
}

TEST(TrackFacts, ProfilesOnAForeignTrackAreTold) {
  EXPECT_TRUE(of(kEurope).notes.empty());
  EXPECT_TRUE(notes_say(of(std::string(kEurope) + "back_to_back = \"1353 mm\"\n"),
                        "S1002 with 1353 mm between the backs: 1360 mm is usual"));
  EXPECT_TRUE(notes_say(of("wheel_profile = \"S1002\"\n"), "S1002 is a wheel of EN, CN60 a rail of CN"));
}

TEST(TrackFacts, DiametersAndDerailedAxlesAreTold) {
  EXPECT_TRUE(notes_say(of("wheel_radius = \"920 mm\"\n"), "is this the diameter?"));
  EXPECT_TRUE(notes_say(of(std::string(kEurope) + "lateral_shift = \"-40 mm\"\n"), "it has derailed"));
  EXPECT_FALSE(notes_say(of(std::string(kEurope) + "lateral_shift = \"-6 mm\"\n"), "it has derailed"));
}

TEST(TrackFacts, TheResolvedCaseIsTheSame) {
  const LoadedCase loaded = of(kEurope), again = parse_case(loaded.resolved_toml, "b.toml");
  EXPECT_EQ(again.resolved_toml, loaded.resolved_toml);
}

}  // namespace railstrata
