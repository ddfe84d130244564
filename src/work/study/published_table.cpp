#include "study/published_table.hpp"
#include "record/json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "many/axis.hpp"

namespace railstrata {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

const CaseRow* entry_at(const std::vector<CaseRow>& entries, const std::string& given, Engine engine) {
  const auto slash = given.find('/');
  for (const CaseRow& e : entries)
    if (e.engine == engine && e.group == given.substr(0, slash) &&
        (slash == std::string::npos || e.name == given.substr(slash + 1)))
      return &e;
  return nullptr;
}

/// The case a column of the comparison takes for `given`: the twin on its own mesh, if the study has that group, else
/// the case itself.
const CaseRow* answer(const std::vector<CaseRow>& entries, const AnswerColumn& column, const std::string& given) {
  if (const CaseRow* twin = column.prefix.empty() ? nullptr : entry_at(entries, column.prefix + given, column.engine))
    return twin;
  return entry_at(entries, given, column.engine);
}

double number_of(const CaseRow* e, const std::string& column) { return e && e->done() ? e->number(column) : kNothing; }

double ours(const PublishedNumber& n, const std::string& column, const AnswerColumn& where,
            const std::vector<CaseRow>& entries) {
  const double a = number_of(answer(entries, where, n.given), column);
  if (n.engines)
    return where.engine == Engine::bem
               ? kNothing
               : 100 * std::abs(a / number_of(entry_at(entries, n.given, Engine::bem), column) - 1);
  if (!n.against.empty()) return 100 * (a / number_of(answer(entries, where, n.against), column) - 1);
  return n.factor * a;
}

bool agrees(const PublishedNumber& n, double v) {
  if (n.bound == "at most") return std::abs(v) <= n.value;
  if (n.bound == "at least") return v >= n.value;
  return std::abs(v - n.value) <= n.within;
}

std::string number_text(double v) { return std::isfinite(v) ? fmt::format("{:.4g}", v) : "–"; }

/// The finite element column without a prefix is the converged one, the one with a prefix the paper's mesh.
struct Answers {
  double paper_mesh = kNothing, converged = kNothing, half_space = kNothing;
};

std::string reason(const PublishedNumber& n, const Answers& a, const Answers& other) {
  const double best = std::isfinite(a.converged) ? a.converged : a.half_space;
  const bool fem = std::isfinite(a.converged) || std::isfinite(a.paper_mesh);
  std::string out;
  if (!std::isfinite(best) && !std::isfinite(a.paper_mesh)) return "no result yet";
  const bool settled = std::isfinite(best) && agrees(n, best),
             on_mesh = std::isfinite(a.paper_mesh) && agrees(n, a.paper_mesh);
  if (settled && std::isfinite(a.paper_mesh) && !on_mesh)
    out = fmt::format("agrees when converged; on the paper's mesh ours gives {}", number_text(a.paper_mesh));
  else if (settled || (on_mesh && !std::isfinite(best)))
    out = "agrees";
  else if (on_mesh)
    out =
        fmt::format("mesh artefact: our run on the paper's mesh agrees, the converged answer is {}", number_text(best));
  else {
    for (const double v : {fem ? other.converged : other.half_space, other.paper_mesh})
      if (out.empty() && std::isfinite(v) && agrees(n, v))
        out = fmt::format("other definition: {} gives {}", n.other_is, number_text(v));
    if (out.empty()) out = "not explained";
  }
  if (!fem)
    out += " (half-spaces alone: no finite element result yet)";
  else if (!std::isfinite(a.converged) && n.only.empty())
    out += " (no converged finite element result yet)";
  return n.note.empty() ? out : out + ". " + n.note;
}

/// A name that no column finds is a mistake of the file, not a result that is missing.
bool is_known(const std::vector<AnswerColumn>& columns, const std::vector<CaseRow>& entries, const std::string& given) {
  return given.empty() || std::any_of(columns.begin(), columns.end(),
                                      [&](const AnswerColumn& c) { return answer(entries, c, given) != nullptr; });
}

std::string given_text(const PublishedNumber& n) {
  return n.against.empty() ? n.given : fmt::format("{} against {}", n.given, n.against);
}

// ---- statements
struct Point {
  double along;
  std::string text;
  double value;
};

bool passes(const CaseRow& e, const std::map<std::string, std::vector<std::string>>& where) {
  for (const auto& [key, allowed] : where) {
    const std::string v = e.value(key);
    if (!v.empty() && std::find(allowed.begin(), allowed.end(), v) == allowed.end()) return false;
  }
  return true;
}

/// Lines of a statement: for each value of `each`, the numbers along `along` in its order. A case without `each`
/// belongs to every line.
std::map<double, std::pair<std::string, std::vector<Point>>> lines_of(const PublishedClaim& c,
                                                                      const AnswerColumn& column,
                                                                      const std::vector<CaseRow>& entries) {
  const auto wanted = [&](const CaseRow& e) {
    const bool twin =
        !column.prefix.empty() && std::any_of(c.groups.begin(), c.groups.end(),
                                              [&](const std::string& g) { return e.group == column.prefix + g; });
    const bool own = column.prefix.empty() && std::find(c.groups.begin(), c.groups.end(), e.group) != c.groups.end();
    return e.engine == column.engine && (twin || own) && e.done() && passes(e, c.where) && !e.value(c.along).empty();
  };
  std::map<double, std::pair<std::string, std::vector<Point>>> lines;
  for (const CaseRow& e : entries)
    if (wanted(e) && (c.each.empty() || !e.value(c.each).empty()))
      lines[c.each.empty() ? 0 : axis_value(e.value(c.each)).first].first = c.each.empty() ? "" : e.value(c.each);
  for (auto& [at, line] : lines) {
    for (const CaseRow& e : entries)
      if (wanted(e) && (c.each.empty() || e.value(c.each).empty() || e.value(c.each) == line.first))
        line.second.push_back({axis_value(e.value(c.along)).first, e.value(c.along), c.factor * e.number(c.column)});
    std::stable_sort(line.second.begin(), line.second.end(),
                     [](const Point& a, const Point& b) { return a.along < b.along; });
  }
  return lines;
}

bool holds(const std::string& kind, const std::vector<Point>& p) {
  const auto rising = [](const Point& a, const Point& b) { return a.value < b.value; };
  const auto falling = [](const Point& a, const Point& b) { return a.value > b.value; };
  const auto all = [&](std::size_t from, std::size_t to, auto&& step) {
    for (std::size_t i = from; i + 1 <= to; ++i)
      if (!step(p[i], p[i + 1])) return false;
    return true;
  };
  if (kind == "rises") return all(0, p.size() - 1, rising);
  if (kind == "falls") return all(0, p.size() - 1, falling);
  const auto lowest = static_cast<std::size_t>(
      std::min_element(p.begin(), p.end(), [](const Point& a, const Point& b) { return a.value < b.value; }) -
      p.begin());
  return lowest > 0 && lowest + 1 < p.size() && all(0, lowest, falling) && all(lowest, p.size() - 1, rising);
}

std::string line_text(const std::pair<std::string, std::vector<Point>>& line) {
  std::vector<std::string> values;
  for (const Point& p : line.second) values.push_back(number_text(p.value));
  return fmt::format("{}{}", line.first.empty() ? "" : line.first + ": ", fmt::join(values, ", "));
}

std::string claim_cell(const PublishedClaim& c, const AnswerColumn& column, const std::vector<CaseRow>& entries) {
  const std::string unit = c.unit.empty() ? "" : " " + c.unit;
  if (c.kind == "above" || c.kind == "below") {
    const double v = c.factor * number_of(answer(entries, column, c.given), c.column);
    if (!std::isfinite(v)) return "no result yet";
    const bool ok = c.kind == "above" ? v > c.limit : v < c.limit;
    return fmt::format("{}: {}{} ({} {}{})", ok ? "confirmed" : "not confirmed", number_text(v), unit, c.kind,
                       number_text(c.limit), unit);
  }
  const auto lines = lines_of(c, column, entries);
  std::vector<std::string> good, bad;
  for (const auto& [at, line] : lines) {
    if (line.second.size() < (c.kind == "falls_then_rises" ? 3u : 2u)) continue;
    (holds(c.kind, line.second) ? good : bad).push_back(line_text(line));
  }
  if (good.empty() && bad.empty()) return "no result yet";
  if (bad.empty()) return fmt::format("confirmed: {}{}", fmt::join(good, "; "), unit);
  if (good.empty()) return fmt::format("not confirmed: {}{}", fmt::join(bad, "; "), unit);
  return fmt::format("in part: not {}{}; confirmed {}{}", fmt::join(bad, "; "), unit, fmt::join(good, "; "), unit);
}

}  // namespace

ReportTable published_table(const Published& published, const std::vector<CaseRow>& entries) {
  ReportTable table{"published",
                    fmt::format("The paper's numbers [{}]", published.source),
                    "",
                    {"section", "quantity", "case", "unit", "paper"},
                    {}};
  for (const AnswerColumn& c : published.columns) table.columns.push_back(c.name);
  table.columns.insert(table.columns.end(), {"difference", "reason"});
  for (const PublishedNumber& n : published.numbers) {
    Answers a, other;
    std::vector<nlohmann::ordered_json> row{n.section, n.quantity, given_text(n), n.unit,
                                            fmt::format("{}{}", n.bound.empty() ? "" : n.bound + " ", n.value)};
    for (const AnswerColumn& c : published.columns) {
      const bool fits = n.only.empty() || std::find(n.only.begin(), n.only.end(), c.name) != n.only.end();
      const double v = fits ? ours(n, n.column, c, entries) : kNothing;
      double Answers::*slot = c.engine == Engine::bem ? &Answers::half_space
                              : c.prefix.empty()      ? &Answers::converged
                                                      : &Answers::paper_mesh;
      a.*slot = v;
      if (fits && !n.other.empty()) other.*slot = ours(n, n.other, c, entries);
      row.push_back(json_number(v));
    }
    const double best = std::isfinite(a.converged)    ? a.converged
                        : std::isfinite(a.half_space) ? a.half_space
                                                      : a.paper_mesh;
    const bool percent = n.unit == "%";
    row.push_back(
        std::isfinite(best) && n.bound.empty()
            ? nlohmann::ordered_json(percent || n.value == 0
                                         ? fmt::format("{:+.1f} {}", best - n.value, percent ? "points" : n.unit)
                                         : fmt::format("{:+.1f} %", 100 * (best / n.value - 1)))
            : nlohmann::ordered_json(nullptr));
    row.push_back(is_known(published.columns, entries, n.given) && is_known(published.columns, entries, n.against)
                      ? reason(n, a, other)
                      : "the study has no such case");
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Difference: the converged finite element answer from the paper's number, or the half-space's where there is "
      "none yet. The reason follows from the runs: it agrees within the tolerance that "
      "published.toml states for the number; or our run on the paper's mesh agrees and the converged one does not; or "
      "another definition agrees; or it is not explained. Nothing is tuned.";
  return table;
}

ReportTable claims_table(const Published& published, const std::vector<CaseRow>& entries) {
  ReportTable table{"claims",
                    "The paper's conclusions",
                    "Every statement as a test of the numbers, in the order of stiffness or thickness.",
                    {},
                    {}};
  std::vector<TextColumn<PublishedClaim>> columns{{"section", &PublishedClaim::section},
                                                  {"statement", &PublishedClaim::text}};
  for (const AnswerColumn& c : published.columns)
    columns.push_back({c.name, [&](const PublishedClaim& claim) { return claim_cell(claim, c, entries); }});
  add_rows(table, published.claims, columns);
  return table;
}

}  // namespace railstrata
