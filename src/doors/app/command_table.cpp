#include <algorithm>
#include <iterator>

#include "app/commands.hpp"

namespace railstrata {

extern const Command kCheckCommand, kRunCommand, kBemCommand, kMaterialCommand, kPassesCommand, kCreepCommand,
    kSweepCommand, kStudyCommand, kCollectiveCommand, kValidateCommand, kReportCommand, kExploreCommand, kExportCommand,
    kInfoCommand;

namespace {

constexpr const Command* kCommands[] = {&kCheckCommand,      &kRunCommand,      &kBemCommand,    &kMaterialCommand,
                                        &kPassesCommand,     &kCreepCommand,    &kSweepCommand,  &kStudyCommand,
                                        &kCollectiveCommand, &kValidateCommand, &kReportCommand, &kExploreCommand,
                                        &kExportCommand,     &kInfoCommand};

constexpr OldName kOldNames[] = {
    {"demo", "run cases/quick"},  {"mesh", "check --mesh"},    {"receptance", "check --receptance"},
    {"shakedown", "bem --maps"},  {"creep-curve", "creep"},    {"creep-table", "creep"},
    {"usetab", "creep --usetab"}, {"wear-loop", "collective"}, {"compare", "report"},
    {"schema", "info --schema"},  {"completion", ""},          {"manual", ""}};

}  // namespace

std::span<const Command* const> commands() { return kCommands; }

const OldName* old_name(std::string_view word) {
  const auto found =
      std::find_if(std::begin(kOldNames), std::end(kOldNames), [&](const OldName& old) { return old.name == word; });
  return found == std::end(kOldNames) ? nullptr : found;
}

}  // namespace railstrata
