#pragma once
#include <exception>
#include <string>

#include "core/faults.hpp"

namespace railstrata {

/// The message of a fault in one line, for a table's column.
inline std::string fault_line(const std::exception& e) {
  const auto* refused = dynamic_cast<const CaseError*>(&e);
  const std::string text = refused && !refused->diagnostics.empty() ? refused->diagnostics.front().message : e.what();
  return text.substr(0, text.find('\n'));
}

}  // namespace railstrata
