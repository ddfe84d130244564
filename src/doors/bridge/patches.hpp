#pragma once
// Contact fields in answers.
#include "bridge/call.hpp"
#include "contact/contact_field.hpp"

namespace railstrata::bridge {

/// Views of its arrays, (stations, columns).
Json patch_of(const ContactField& field);

}  // namespace railstrata::bridge
