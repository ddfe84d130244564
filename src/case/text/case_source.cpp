#include "text/case_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/printable.hpp"

namespace railstrata {
namespace {

/// The entry of a key or of the nearest table above it.
template <class Value>
const Value* nearest(const std::map<std::string, Value>& known, std::string key) {
  for (;; key.resize(key.rfind('.'))) {
    if (const auto found = known.find(key); found != known.end()) return &found->second;
    if (key.find('.') == std::string::npos) return nullptr;
  }
}

}  // namespace

CaseSource::CaseSource(std::filesystem::path file, std::string text) : file_(std::move(file)), text_(std::move(text)) {
  std::istringstream stream(text_);
  for (std::string line; std::getline(stream, line);) {
    if (line.ends_with('\r')) line.pop_back();
    lines_.push_back(line);
  }
}

std::string CaseSource::caret_lines(TextPlace place) const {
  if (place.line < 1 || place.line > static_cast<int>(lines_.size())) return {};
  const std::string& line = lines_[place.line - 1];
  std::size_t before = std::min(line.size(), static_cast<std::size_t>(std::max(place.column - 1, 0)));
  while (before < line.size() && before > 0 && (line[before] & 0xC0) == 0x80) ++before;
  std::string indent;
  for (const char c : printable(std::string_view(line).substr(0, before)))
    if ((c & 0xC0) != 0x80) indent += c == '\t' ? '\t' : ' ';
  return fmt::format("\n{:5} | {}\n      | {}^", place.line, printable(line), indent);
}

CaseSource::Found CaseSource::found_at(TextPlace place, const std::string& message, const std::string& remedy) const {
  return {place,
          {fmt::format("{}:{}:{}", file_.string(), place.line, place.column), message + caret_lines(place), remedy}};
}

CaseSource::Found CaseSource::found_at(const std::string& key, const std::string& message,
                                       const std::string& remedy) const {
  // an override replaces all that the text has below its key
  if (const std::string* origin = nearest(origins_, key))
    return {{std::numeric_limits<int>::max(), 0}, {*origin, message, remedy}};
  if (const TextPlace* place = nearest(places_, key)) return found_at(*place, message, remedy);
  return {{}, {file_.string(), message, remedy}};
}

void CaseSource::complain_at(TextPlace place, const std::string& message, const std::string& remedy) {
  found_.push_back(found_at(place, message, remedy));
}

Diagnostic CaseSource::diagnosis(const std::string& key, const std::string& message, const std::string& remedy) const {
  return found_at(key, message, remedy).diagnostic;
}

bool CaseSource::sound(std::initializer_list<std::string_view> keys) const {
  return std::none_of(unsound_.begin(), unsound_.end(), [&](const std::string& bad) {
    return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
      return bad.starts_with(key) && (bad.size() == key.size() || bad[key.size()] == '.');
    });
  });
}

void CaseSource::complain(const std::string& key, const std::string& message, const std::string& remedy) {
  unsound_.push_back(key);
  found_.push_back(found_at(key, message, remedy));
}

void CaseSource::complain_elsewhere(const std::string& key, Diagnostic elsewhere) {
  unsound_.push_back(key);
  found_.push_back({found_at(key, {}, {}).place, std::move(elsewhere)});
}

void CaseSource::finish() const {
  if (found_.empty()) return;
  std::vector<Found> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Found& a, const Found& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  std::vector<Diagnostic> all;
  for (Found& f : sorted) all.push_back(std::move(f.diagnostic));
  throw CaseError(std::move(all));
}

}  // namespace railstrata
