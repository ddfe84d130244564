#pragma once
// Headings of spreadsheets beside the keys of columns: German, French, Swedish, Chinese.
#include <string_view>
#include <vector>

namespace railstrata {

/// What a column of this key is called too; none for a key that has no other word.
const std::vector<std::string_view>& words_of(std::string_view key);

}  // namespace railstrata
