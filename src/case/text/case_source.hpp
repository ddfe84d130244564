#pragma once
// The text of a case file and everything known about it: places, source lines with a caret, and the errors found so
// far.
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/faults.hpp"

namespace railstrata {

/// Line and column, one-based; line 0: not in the text (a default, or an override of the command line).
struct TextPlace {
  int line = 0, column = 0;
};

class CaseSource {
 public:
  CaseSource(std::filesystem::path file, std::string text);

  const std::string& text() const { return text_; }
  const std::filesystem::path& file() const { return file_; }

  /// Where the value of a key stands ("geometry.gauge", "layer.0.young"). `origin` names a value that came from
  /// elsewhere ("--set …").
  void remember(const std::string& key, TextPlace place) { places_[key] = place; }
  void remember_origin(const std::string& key, std::string origin) { origins_[key] = std::move(origin); }

  /// The text or an override gives this very key.
  bool has(const std::string& key) const { return places_.contains(key) || origins_.contains(key); }
  bool has_origin(const std::string& key) const { return origins_.contains(key); }

  /// Records an error at a key, or at the nearest table above it that the file has. `message` is followed by the source
  /// line and a caret.
  void complain(const std::string& key, const std::string& message, const std::string& remedy);
  /// The same, given back instead of recorded.
  Diagnostic diagnosis(const std::string& key, const std::string& message, const std::string& remedy) const;
  /// Records an error of a file that the value of `key` names, at its own place there.
  void complain_elsewhere(const std::string& key, Diagnostic elsewhere);
  /// Records an error at a place of the text.
  void complain_at(TextPlace place, const std::string& message, const std::string& remedy);
  /// Throws CaseError with everything recorded, in the order of the file; overrides last.
  void finish() const;
  /// No error is recorded at these keys (or inside them): a rule between options checks only values that were
  /// understood.
  bool sound(std::initializer_list<std::string_view> keys) const;

 private:
  struct Found {
    TextPlace place;
    Diagnostic diagnostic;
  };
  std::string caret_lines(TextPlace place) const;
  Found found_at(const std::string& key, const std::string& message, const std::string& remedy) const;
  Found found_at(TextPlace place, const std::string& message, const std::string& remedy) const;
  std::filesystem::path file_;
  std::string text_;
  std::vector<std::string> lines_;
  std::map<std::string, TextPlace> places_;
  std::map<std::string, std::string> origins_;
  std::vector<std::string> unsound_;
  std::vector<Found> found_;
};

}  // namespace railstrata
