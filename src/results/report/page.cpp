#include "report/page.hpp"

#include <fmt/format.h>

#include "io/provenance.hpp"
#include "record/escaped_text.hpp"
#include "record/json.hpp"
#include "report/assets.hpp"
#include "report/payload.hpp"

namespace railstrata {
namespace {

/// The framed page as a text that the script hands to its frame; nothing without one.
std::string frame_block(const FramedPage& frame) {
  if (frame.text.empty()) return {};
  return fmt::format("<script type=\"application/json\" id=\"what-if-page\">{}</script>\n",
                     json_in_page(json_text(nlohmann::ordered_json(frame.text))));
}

}  // namespace

std::string report_page(const Report& report, const FramedPage& what_if) {
  const std::string policy =
      fmt::format("default-src 'none'; script-src {}{}; style-src {}{}; {}base-uri 'none'; form-action 'none'",
                  policy_hash(report_script()), what_if.script_policy, policy_hash(report_style()),
                  what_if.style_policy, what_if.further_policy);
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"generator\" "
      "content=\"RailStrata {}\">\n<title>{}</title>\n<style>{}</style>\n</head>\n"
      "<body>\n<noscript>This page draws its figures with a script of its own; allow scripts to see it.</noscript>\n"
      "<script type=\"application/json\" id=\"data\">{}</script>\n{}<script>{}</script>\n"
      "</body>\n</html>\n",
      policy, version_text(), markup_text(report.title), report_style(),
      json_in_page(json_text(report_payload(report))), frame_block(what_if), report_script());
}

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

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
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
