#include "case/text_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kLargest = std::size_t{4} << 20;  // nobody writes more by hand

}  // namespace

std::string read_text_file(const std::filesystem::path& file, const std::string& remedy) {
  std::error_code error;  // of a name too long, a folder that may not be looked into: told below
  if (std::filesystem::is_directory(file, error))
    throw CaseError(fmt::format("{} is a folder", file.string()), "name the file in it");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw CaseError(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)), remedy);
  std::string text;
  std::array<char, 1 << 16> piece;
  while (stream.read(piece.data(), piece.size()) || stream.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargest)
      throw CaseError(fmt::format("{} is larger than {} MiB", file.string(), kLargest >> 20), remedy);
  }
  return text;
}

}  // namespace railstrata
