#pragma once
// Flags of a contact problem: which values are offered.
#include <string>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// Takes a value. Returns a remark where it has no effect, "" otherwise; throws Refused for what is not offered.
std::string set_flag(Problem& problem, int code, int value);

/// The flag's value or its default; -1: unknown flag.
int get_flag(const Problem& problem, int code);

}  // namespace railstrata::cntc
