#pragma once
// What a collective's wear rests on, in words.
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "collective/collective.hpp"

namespace railstrata {

/// Whose wear the rail's depths by a law are; empty where the law asks for a hardness instead.
std::string steel_words(const std::vector<CollectiveRow>& rows, WearLaw law);

/// What of the rail's wear by Jendel's map its tests hardly reach; empty where that is little, and of other laws.
std::string map_words(const std::vector<CollectiveRow>& rows, WearLaw law);

/// How many loads roll free since their rows give no traction and [drive] has none; empty: none.
std::string free_words(const std::vector<CollectiveRow>& rows);

/// Factor, source and words of rail and wheel; empty without a sound row.
nlohmann::ordered_json wear_of_steels(const std::vector<CollectiveRow>& rows);

}  // namespace railstrata
