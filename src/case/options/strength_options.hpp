#pragma once
// The keys of what a material bears (spec/strength_spec.hpp), the same for rail, wheel and layers.
#include <string_view>
#include <vector>

#include "options/option_table.hpp"

namespace railstrata {

enum class StrengthPlace { rail, wheel, layer };

std::vector<Option> strength_options(StrengthPlace place);

/// Keys of these options for the same quantity.
std::vector<std::vector<std::string_view>> strength_rivals();

/// The depth of a table by depth, which begins at `top` and ends at most at `deepest` [m].
Option depth_column(std::string_view top, double deepest);

}  // namespace railstrata
