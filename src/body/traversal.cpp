#include "body/traversal.hpp"

#include "body/traversal_kernel.hpp"

namespace railstrata {

template class TraversalOf<BodyElement>;
template void TraversalOf<BodyElement>::chain_forces(const Chain&, const Field&, Field&, Field&, const StoreForces&);
template void TraversalOf<BodyElement>::chain_forces(const Chain&, const Field&, Field&, Field&, const FuseUpdate&);

}  // namespace railstrata
