#pragma once
// Options that a line contact (geometry.contact = "line") cannot have: anything that turns or moves the cylinder
// sideways, and whatever asks for a displacement of distant points, which plane strain does not know.
#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

void check_line_contact(const CaseSpec& spec, CaseSource& source);

}  // namespace railstrata
