#include "report/page_parts.hpp"

#include "io/provenance.hpp"
#include "report/base64.hpp"

namespace railstrata {

std::string json_in_page(const std::string& json) {
  std::string out;
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string policy_hash(std::string_view text) {
  const std::string hex = sha256_of(text);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return "'sha256-" + base64_of(bytes) + "'";
}

}  // namespace railstrata
