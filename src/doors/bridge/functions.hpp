#pragma once
// The functions that the bridge offers, by name.
#include <map>
#include <string>

#include "bridge/call.hpp"

namespace railstrata::bridge {

using Functions = std::map<std::string, void (*)(Call&)>;

/// All of them.
const Functions& functions();

// Functions of the bridge, one list for each source file.
Functions case_functions();
Functions contact_functions();
Functions damage_functions();
Functions folder_functions();
Functions half_space_functions();
Functions material_functions();
Functions pass_functions();
Functions run_functions();
Functions sweep_functions();
Functions table_functions();
Functions wheelset_functions();

}  // namespace railstrata::bridge
