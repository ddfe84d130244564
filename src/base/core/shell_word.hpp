#pragma once
// Words of a command line that is printed for the user to copy.
#include <string>

namespace railstrata {

/// The word as a POSIX shell reads it back: as it is where that is safe, in single quotes otherwise.
std::string shell_word(const std::string& word);

}  // namespace railstrata
