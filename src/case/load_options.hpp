#pragma once
// The keys of load collectives: [[load]] and [collective].
#include "case/option_table.hpp"

namespace railstrata {

OptionTable load_table();
OptionTable collective_table();

}  // namespace railstrata
