#include "io/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/faults.hpp"

namespace railstrata {

std::string read_text_file(const std::filesystem::path& file, const std::string& remedy) {
  if (std::filesystem::is_directory(file)) throw CaseError(fmt::format("{} is a folder", file.string()), "name the file in it");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw CaseError(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)), remedy);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace railstrata
