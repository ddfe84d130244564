#include "text/text_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/faults.hpp"
#include "core/printable.hpp"
#include "text/open_file.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kLargest = std::size_t{64} << 20;  // bytes; a measured kilometre every millimetre has 20 MB
constexpr int kPatience = 2000;                          // ms, until a writer opens a named pipe
constexpr int kForEver = -1;

[[noreturn]] void refuse_unreadable(const std::filesystem::path& file, int reason, const std::string& remedy) {
  throw CaseError(fmt::format("cannot read {}: {}", file.string(), std::strerror(reason)),
                  reason == EACCES || reason == EPERM
                      ? fmt::format("ask its owner to make it readable: chmod +r {}", file.string())
                      : remedy);
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, const std::string& remedy,
                           std::vector<std::string>* notes) {
  std::error_code error;  // of a name too long, a folder that may not be looked into: open() reports it below
  if (std::filesystem::is_directory(file, error))
    throw CaseError(fmt::format("{} is a folder", file.string()), "name the file in it");
  const OpenFile in(file);
  if (!in.is_open()) refuse_unreadable(file, errno, remedy);
  const bool silent = std::filesystem::is_fifo(file, error) && !in.wait(kPatience);
  std::string text;
  std::array<char, 1 << 16> piece;
  for (;;) {
    const std::ptrdiff_t count = in.read(piece.data(), piece.size());
    const int reason = errno;
    if (count == 0) break;
    if (count > 0)
      text.append(piece.data(), static_cast<std::size_t>(count));
    else if (reason == EAGAIN)
      in.wait(kForEver);
    else if (reason != EINTR)
      refuse_unreadable(file, reason, remedy);
    if (text.size() > kLargest)
      throw CaseError(fmt::format("{} is larger than {} MiB", file.string(), kLargest >> 20),
                      "tables of measurements have some megabytes: was another file meant?");
  }
  if (silent && text.empty())
    throw CaseError(fmt::format("{} is a named pipe, and nothing writes into it", file.string()),
                    "start the program that writes into it first, or name a file");
  if (const std::string sign = sign_of_binary(text); !sign.empty())
    throw CaseError(fmt::format("{} is not a text: {}", file.string(), sign),
                    "was another file meant? If it is a text, save it as UTF-8");
  DecodedText out = decoded(std::move(text));
  if (out.from_windows_1252 && notes)
    notes->push_back(fmt::format("{} is not in UTF-8: it was read as Windows-1252", file.string()));
  return std::move(out.text);
}

}  // namespace railstrata
