#pragma once
// Rules of [[irregularity]], and the file that one of them names.
#include <filesystem>
#include <string>

#include "case/case_fwd.hpp"
#include "case/case_source.hpp"

namespace railstrata {

/// The largest slope of a height against the way: contact is computed as that of surfaces without slope.
inline constexpr double kSteepestHeight = 0.2;
/// Cells or elements of a wave.
inline constexpr double kLeastOfWave = 6;

/// Records every broken rule in `source`.
void check_irregularities(const CaseSpec& spec, CaseSource& source);

/// Throws CaseError for waves shorter than six cells or elements of a size [m].
void require_fine_enough(const CaseSpec& spec, double size, const char* what, const char* key);
/// Throws CaseError for a case whose rail or wheel varies along the way: `what` needs steady rolling.
void require_same_along(const CaseSpec& spec, const char* what);

/// Reads columns x, z or x, y, z into an entry. Throws CaseError with file, line and remedy.
void read_heights(const std::string& text, const std::filesystem::path& file, CaseSpec& spec, std::size_t index);

}  // namespace railstrata
