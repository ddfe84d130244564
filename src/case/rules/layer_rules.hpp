#pragma once
// Rules of [[layer]] and [[stretch]].
#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Records every broken rule in `source`.
void check_layers(const CaseSpec& spec, CaseSource& source);

}  // namespace railstrata
