#pragma once
// The three kinds of failure a user can meet, each with its own exit code. A programmer's fault is an assert.
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace railstrata {

/// Exit codes of the program (docs/conventions.md).
enum class ExitCode : int {
  ok = 0,
  failed_checks = 1,
  user = 2,
  numerics = 3,
  environment = 4,
  unfinished = 5,
  internal = 70,
  interrupted = 130
};

/// Something the user wrote is wrong: a case file, a profile, a command line. Exit code 2.
/// `where` is "file:line:column" as far as it is known; `remedy`: what the user can do.
struct Diagnostic {
  std::string where;
  std::string message;
  std::string remedy;
};

class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<Diagnostic> all) : std::runtime_error(text(all)), diagnostics(std::move(all)) {}
  explicit CaseError(std::string message, std::string remedy = {}, std::string where = {})
      : CaseError(std::vector<Diagnostic>{{std::move(where), std::move(message), std::move(remedy)}}) {}
  /// Every error of the input at once, in the order of the file.
  std::vector<Diagnostic> diagnostics;

 private:
  static std::string text(const std::vector<Diagnostic>& all) {
    std::string out;
    for (const Diagnostic& d : all) {
      if (!out.empty()) out += '\n';
      if (!d.where.empty()) out += d.where + ": ";
      out += d.message;
      if (!d.remedy.empty()) out += "\n    remedy: " + d.remedy;
    }
    return out;
  }
};

/// The numbers went wrong: NaN, inverted element, no convergence. The message names where and when. Exit code 3.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The machine cannot do it: disk full, no permission, not enough memory. Exit code 4. `remedy`: what the user can do;
/// may be empty.
class EnvironmentError : public std::runtime_error {
 public:
  explicit EnvironmentError(const std::string& message, std::string what_to_do = {})
      : std::runtime_error(message), remedy(std::move(what_to_do)) {}
  std::string remedy;
};

/// Someone asked to stop before there was anything to keep. Exit code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The message of a fault in one line, for a table's column.
inline std::string fault_line(const std::exception& e) {
  const auto* refused = dynamic_cast<const CaseError*>(&e);
  const std::string text = refused && !refused->diagnostics.empty() ? refused->diagnostics.front().message : e.what();
  return text.substr(0, text.find('\n'));
}

}  // namespace railstrata
