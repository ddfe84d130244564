#include <fmt/format.h>

#include "app/commands.hpp"
#include "case/case_schema.hpp"

namespace railstrata {

ExitCode command_schema(const CommandOptions& options) {
  fmt::print("{}", options.schema.markdown ? case_reference_markdown() : case_json_schema());
  return ExitCode::ok;
}

}  // namespace railstrata
