#include "app/commands.hpp"
#include "core/faults.hpp"
namespace railstrata {
ExitCode command_compare(const CommandOptions&) { throw CaseError("not there yet"); }
}  // namespace railstrata
