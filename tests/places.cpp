#include "tests/places.hpp"

#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX

#include <stdexcept>
#include <string>
#include <system_error>

namespace railstrata {

std::filesystem::path source_dir() { return RAILSTRATA_SOURCE_DIR; }

TemporaryFolder::TemporaryFolder() {
  std::string name = std::filesystem::temp_directory_path() / "railstrata-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace railstrata
