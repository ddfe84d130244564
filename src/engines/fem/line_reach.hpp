#pragma once
// Which stations of the lines (nodes on the running surface, at ties, with added mass) each of several ranks keeps.
//
// A rank knows displacements where its own tiles read them, on the running surface around the contact, and at the ends
// of open blocks (their absorbers). Slaves there need their masters, in whatever block: `values` is closed under that.
// Forces there are whole where those on all nodes of chains with added mass are, and those on all slaves: `forces` is
// closed under that. Both are whole groups of stations (kStationGroup).
#include <vector>

#include "body/mass_scaling.hpp"
#include "body/ties.hpp"
#include "body/tile_cut.hpp"
#include "model/model.hpp"

namespace railstrata {

/// m, along the rail from the axle: how far the search for the contact looks.
double search_half_length(const Model& model);

/// Where the contact is looked for until the wheel has gone `stride` further.
struct ContactWindow {
  ContactWindow(const Model& model, const SweptBody& rail, const SweptBody& wheel);
  double half_length, stride;  ///< m
  double rail_start, radius;   ///< m: the axle's start along the rail's stations; the least of the running surface
};

/// Section nodes by block.
using NodesOfBlocks = std::vector<std::vector<int>>;
/// Those in a mask by block and node.
NodesOfBlocks chosen_nodes(const NodeMask& mask);
/// Those on the axle of a body that turns, but for `lines`.
NodesOfBlocks nodes_on_axle(const SweptBody& mesh, const NodesOfBlocks& lines);

/// A body as the ranks share its lines. contact +- half_width: in its sweep coordinate, m or rad.
struct SharedLines {
  const SweptBody& mesh;
  const BodyLayout& layout;
  const Tiling& tiling;
  const Ties& ties;
  const TileCut& cut;
  const NodesOfBlocks& lines;
  const std::vector<MassScaling::Chain>& chains;  ///< with added mass
  double contact = 0, half_width = 0;
};

/// Ranges of one rank.
struct LineReach {
  LineStations values, forces;
};
std::vector<LineReach> line_reaches(const SharedLines& body, int ranks);

/// Whether the moments of a body's slaves follow from forces that the elements of single tiles give: not where slaves
/// carry others, or the axle carries some. Then every rank collects those on all of them.
bool moments_of_tiles(const SweptBody& mesh, const Ties& ties);

/// Numbers of a stretch and a line: all but those of its first plane.
inline int moment_numbers(const Chain& stretch) { return 2 * (stretch.end_tile - stretch.first_tile) - 1; }

/// Forces on lines that a stretch's owner gives in a usual step, by section node: those that another rank collects.
using SentRanges = std::vector<StationRanges>;
/// By stretch, in their order (body/tile_cut.hpp).
std::vector<SentRanges> sent_ranges(const SharedLines& body, const std::vector<LineReach>& reaches);

}  // namespace railstrata
