#include "body/traversal.hpp"

#include "body/traversal_kernel.hpp"

namespace railstrata {

template class TraversalOf<ElasticHex>;
template void TraversalOf<ElasticHex>::chain_forces(const Chain&, const Field&, Field&, Field&, const StoreForces&);
template void TraversalOf<ElasticHex>::chain_forces(const Chain&, const Field&, Field&, Field&, const FuseUpdate&);

}  // namespace railstrata
