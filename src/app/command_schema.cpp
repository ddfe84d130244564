#include <fmt/format.h>

#include "app/commands.hpp"
#include "case/case_schema.hpp"
#include "io/result_reference.hpp"

namespace railstrata {

ExitCode command_schema(const CommandOptions& options) {
  const bool markdown = options.schema.markdown;
  if (options.schema.results)
    fmt::print("{}", markdown ? results_reference_markdown() : results_reference_json().dump(2) + "\n");
  else
    fmt::print("{}", markdown ? case_reference_markdown() : case_json_schema());
  return ExitCode::ok;
}

}  // namespace railstrata
