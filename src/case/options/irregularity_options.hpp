#pragma once
// The kinds of [[irregularity]] as a case names them; geometry/irregularity.hpp has their shapes.
#include <string_view>
#include <vector>

namespace railstrata {

struct IrregularityKind {
  std::string_view word;
  std::vector<std::string_view> needed;  ///< keys
};

/// In the order of IrregularityShape.
const std::vector<IrregularityKind>& irregularity_kinds();

}  // namespace railstrata
