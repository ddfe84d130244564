#include "report/page.hpp"

#include <fmt/format.h>

#include "io/json_text.hpp"
#include "io/markup_text.hpp"
#include "io/provenance.hpp"
#include "report/assets.hpp"
#include "report/base64.hpp"
#include "report/payload.hpp"

namespace railstrata {
namespace {

/// Inside a script element nothing may look like a tag; in JSON "<" stands in texts only, where \u003c means the same.
std::string without_tags(const std::string& json) {
  std::string out;
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

/// 'sha256-…' as a Content-Security-Policy names a script or style.
std::string source_hash(std::string_view text) {
  const std::string hex = sha256_of(text);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return "'sha256-" + base64_of(bytes) + "'";
}

}  // namespace

std::string report_page(const Report& report) {
  // Plotly makes an empty style element and fills it rule by rule: the empty text has a hash too; and it sets style
  // attributes, which can do no more than look. Maps and saved pictures are data and blob addresses of the page itself.
  const std::string policy = fmt::format(
      "default-src 'none'; script-src {}; style-src {} {}; style-src-attr 'unsafe-inline'; img-src data: blob:; "
      "base-uri 'none'; form-action 'none'",
      source_hash(report_script()), source_hash(report_style()), source_hash(""));
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"generator\" "
      "content=\"RailStrata {}\">\n<title>{}</title>\n<style>{}</style>\n</head>\n"
      "<body>\n<noscript>This page draws its figures with a script of its own; allow scripts to see it.</noscript>\n"
      "<script type=\"application/json\" id=\"data\">{}</script>\n<template "
      "id=\"licences\"><pre>{}</pre></template>\n<script>{}</script>\n</body>\n</html>\n",
      policy, version_text(), markup_text(report.title), report_style(),
      without_tags(json_text(report_payload(report))), markup_text(report_licences()), report_script());
}

}  // namespace railstrata
