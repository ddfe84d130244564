#pragma once
// Interfaces below layers that have come off their base: sections whose nodes stand twice there.
#include "mesh/bodies.hpp"

namespace railstrata {

/// Doubles the nodes of the contact band below every layer that is unbonded somewhere: within the columns that the
/// layer has of the band; those of its edges, and of the band's, stay single. The section still stands upright under
/// the profile's origin. Throws CaseError where the band has no row of elements below the layer, or too few columns.
void split_interfaces(SweptBody& body, const std::vector<LayerMesh>& layers);

/// The same body with ties across all its interfaces: the layers hold everywhere.
SweptBody bonded(SweptBody body);

/// SplitInterface::below of all interfaces, one after the other.
std::vector<int> nodes_below(const SweptBody& body);

/// visit(above, below): nodes of the band's block, for every pair of an interface.
template <class Visit>
void each_pair(const SplitInterface& interface, const ContactBand& band, Visit&& visit) {
  for (std::size_t k = 0; k < interface.below.size(); ++k)
    visit(interface.row * (band.columns + 1) + interface.first_column + static_cast<int>(k), interface.below[k]);
}

}  // namespace railstrata
