#include "app/page_name.hpp"

#include <fmt/format.h>

#include <cctype>

#include "core/faults.hpp"
#include "record/escaped_text.hpp"

namespace railstrata {

bool is_page_name(const std::filesystem::path& page) {
  std::string ending = page.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".html" || ending == ".htm";
}

void require_name_of_page(const std::filesystem::path& page, const std::string& preset) {
  if (is_page_name(page)) return;
  const std::filesystem::path name = page.filename();
  const bool folder = name.empty() || name == "." || name == "..";
  const std::filesystem::path other = folder ? page / preset : std::filesystem::path(page).replace_extension(".html");
  throw CaseError(fmt::format("--out {}: a page has a name that ends in .html", page.string()),
                  fmt::format("write for example --out {}", shell_word(other.string())));
}

}  // namespace railstrata
