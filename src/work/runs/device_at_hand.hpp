#pragma once
// Whether this machine and its ranks can compute where a case asks for, found before anything is computed.
#include "core/ranks.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

/// Checks a case that rolls. Throws CaseError where several ranks cannot share it, EnvironmentError where run.device =
/// "gpu" and the program was built without CUDA or no card is found; both with a remedy.
void require_device(const CaseSpec& spec, const Ranks& ranks = {});

/// The same with the place of the key in the case's file.
void require_device(const LoadedCase& loaded, const Ranks& ranks = {});

}  // namespace railstrata
