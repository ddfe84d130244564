#pragma once
// Contact fields in answers, points and stresses inside the bodies.
#include <array>
#include <vector>

#include "bridge/call.hpp"
#include "contact/contact_field.hpp"
#include "core/vec.hpp"

namespace railstrata::bridge {

/// Views of its arrays, (stations, columns).
Json patch_of(const ContactField& field);

/// Of an array (n, 3). Throws std::invalid_argument: another shape, a number that is none.
std::vector<Vec3> points_of(const Array& given);

/// xx, yy, zz, xy, yz, xz.
std::array<double, 6> components(const Sym3& stress);
/// (n, 6), as "stresses".
void answer_stresses(Call& call, const std::vector<Sym3>& stresses);

}  // namespace railstrata::bridge
