#pragma once
// Keys of a case that have a feature of the table of clashes.
#include <initializer_list>

#include "rules/clashes.hpp"

namespace railstrata {

struct LayerSpec;

Keys keys_of_layers(const CaseSpec& c, const char* key, bool (*has)(const LayerSpec&));
/// Those of these keys of layers that the text gives.
Keys given_in_layers(const CaseSpec& c, const CaseSource* text, std::initializer_list<const char*> keys);
/// Those of a track that an even support without mass does not have, where they are not those of its set.
Keys keys_of_sleepers(const CaseSpec& c, const CaseSource* text);

}  // namespace railstrata
