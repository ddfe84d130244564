#pragma once
// "Did you mean …?" for keys, units, profile names and commands.
#include <string>
#include <string_view>
#include <vector>

namespace railstrata {

/// Least number of inserted, deleted, replaced or swapped neighbouring letters between two words, capitals aside
/// (optimal string alignment).
int edit_distance(std::string_view a, std::string_view b);

/// The word nearest to `typed` when it is near enough to be meant (at most a third of its letters differ, or one starts
/// with the other); empty otherwise.
std::string nearest_word(std::string_view typed, const std::vector<std::string>& words);

}  // namespace railstrata
