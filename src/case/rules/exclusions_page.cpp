#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "rules/clashes.hpp"

namespace railstrata {
namespace {

using enum ClashRule;
using Rules = std::initializer_list<ClashRule>;

/// The keys as code, and what the feature is.
std::string cell(const Feature& f) {
  std::string out = fmt::format("`{}`", f.key);
  for (std::size_t at = 0; (at = out.find(" | ", at)) != std::string::npos;) out.replace(at, 3, "`, `");
  return f.name.empty() ? out : fmt::format("{} ({})", out, f.name);
}

/// The first column of a use; of two features the first two.
std::string cells(const Clash& c) {
  const char* const word = c.rule == needs || c.rule == idle_without ? "without" : "with";
  if (c.a.use) return fmt::format("{} {}", word, cell(c.b));
  if (c.b.use) return cell(c.a);
  return c.in ? fmt::format("{} {} {}", cell(c.a), word, cell(c.b)) : fmt::format("{} | {}", cell(c.a), cell(c.b));
}

/// Rows of these rules for a use; null: for any. `head`: of the columns before the reason; empty without rows.
std::string table(const Use* use, Rules rules, std::string_view head) {
  std::string rows;
  for (const Clash& c : clash_table())
    if (c.of() == use && std::find(rules.begin(), rules.end(), c.rule) != rules.end())
      rows += fmt::format("| {} | {} | {} |\n", cells(c), c.why, c.remedy);
  if (rows.empty()) return rows;
  return fmt::format("| {} | because | do instead |\n|---|---|{}\n{}\n", head, use ? "---|" : "---|---|", rows);
}

/// Every use of the table, in its order.
std::vector<const Use*> all_uses() {
  std::vector<const Use*> out;
  for (const Clash& c : clash_table())
    if (const Use* use = c.of(); use && std::find(out.begin(), out.end(), use) == out.end()) out.push_back(use);
  return out;
}

std::string heading(std::string name) {
  name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
  return fmt::format("### {}\n\n", name);
}

}  // namespace

std::string exclusions_markdown() {
  std::string out =
      "# What excludes what\n\n<!-- Written by `railstrata info --schema --exclusions` from "
      "src/case/rules/clashes.cpp; a test holds this page against the program. -->\n\n"
      "A case that breaks one of these rules is refused before anything is meshed or solved, with the place in its\n"
      "file. Ranges of numbers are in the [case reference](case-reference.md)."
      "\n\n## Settings that exclude each other\n\n";
  out += table(nullptr, {excludes}, "setting | cannot be combined with");
  out += "## Settings that need another\n\n" + table(nullptr, {needs}, "setting | needs");
  out +=
      "## What engines and commands do not support\n\nThe finite elements are `railstrata run` and `passes --engine "
      "fem`, half-spaces the other commands.\n\n";
  for (const Use* use : all_uses()) {
    const std::string rows = table(use, {excludes, needs}, "not supported");
    if (rows.empty()) continue;
    out += heading(std::string(use->name));
    if (use->part_of) out += fmt::format("Besides what {} cannot take:\n\n", use->part_of->name);
    out += rows;
  }
  out += "## Settings without effect\n\nA note reports the setting, and the case is computed.\n\n";
  out += table(nullptr, {idle_with}, "setting | has no effect with");
  out += table(nullptr, {idle_without}, "setting | has no effect without");
  for (const Use* use : all_uses())
    if (const std::string rows = table(use, {idle_with}, "without effect"); !rows.empty())
      out += heading(std::string(use->name)) + rows;
  out.pop_back();
  return out;
}

}  // namespace railstrata
