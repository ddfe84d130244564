#pragma once
// The numbers of wheelset and track that decide where a wheel stands, and where each comes from.
#include <string>
#include <vector>

#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

struct GeometrySpec;

struct TrackFact {
  std::string label, value, from;  ///< "between the backs", "1360 mm", "EN, of S1002" or "given; EN has 1360 mm"
};
/// Of a pair with an arc or a plane inclination and radius alone: it stands over the rail's axis.
std::vector<TrackFact> track_facts(const GeometrySpec& geometry);

/// What is unusual of wheel, rail and track together: reported, not refused.
std::vector<std::string> track_notes(const CaseSpec& spec, const CaseSource& source);

}  // namespace railstrata
