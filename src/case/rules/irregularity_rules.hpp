#pragma once
// Rules of [[irregularity]], and the file that one of them names.
#include <filesystem>
#include <optional>
#include <string>

#include "core/faults.hpp"
#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

struct Irregularity;  // geometry/irregularity.hpp

/// The largest slope of a height against the way: contact is computed as that of surfaces without slope.
inline constexpr double kSteepestHeight = 0.2;

/// Records every broken rule in `source`.
void check_irregularities(const CaseSpec& spec, CaseSource& source);

/// The fault of an entry with waves shorter than six cells or elements (`what`) of a size [m], which `key` gives.
std::optional<Diagnostic> too_coarse(const CaseSpec& spec, std::size_t index, double size, const char* what,
                                     const char* key);
/// Throws CaseError for the first of them.
void require_fine_enough(const CaseSpec& spec, double size, const char* what, const char* key);

/// The name of the file that an entry's numbers are in; null: its kind has none.
std::string* file_of_heights(Irregularity& irregularity);

/// Reads columns x, z or x, y, z into an entry; of a wheel angle and run-out, whose way is that on the tread; of levels
/// wavelength and level. An x beyond its range, a chainage, counts from the first row: the returned note names that,
/// else it is empty. Throws CaseError with file, line and remedy.
std::string read_heights(const std::string& text, const std::filesystem::path& file, CaseSpec& spec, std::size_t index);

}  // namespace railstrata
