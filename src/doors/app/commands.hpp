#pragma once
// The subcommands. Each reads its case, calls the rooms below and prints; exceptions carry faults to program.cpp.
#include <filesystem>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace CLI {
class App;
}

namespace railstrata {

/// Options that only one command has.
struct RunOptions {
  std::filesystem::path resume;             ///< --resume: a result folder with a checkpoint
  std::string checkpoint_every = "10 min";  ///< --checkpoint-every: a wall time
  std::string max_time = "never";           ///< --max-time: a wall time
};
struct CreepCurveOptions {
  std::string of = "creepage";  ///< --of: the word of what varies
  double largest = 0;           ///< --largest: creepage, or spin in 1/m; 0: chosen
  int points = 21;              ///< --points
  bool both_sides = false;      ///< --both-sides: braking and driving, left and right
};
struct ReceptanceOptions {
  double largest = 3000;       ///< --largest, Hz
  std::string time = "0.1 s";  ///< --time: how long a blow is followed
  bool beam = false;           ///< --beam: without finite elements
};
struct CreepTableCommandOptions {
  std::vector<std::string> axes;  ///< --axis
  std::string scaled;             ///< --scaled ANGLES:SPINS:SIZES; empty: a plain table
  int places = 200;               ///< --places, where interpolation is compared with direct solutions
  bool resume = false;            ///< --resume
};
struct SweepCommandOptions {
  std::vector<std::string> vary;  ///< --vary
  bool stresses = false;          ///< --stresses
};
struct WearLoopOptions {
  int steps = 0;                      ///< --steps; 0: no limit
  double passages = 0;                ///< --passages; 0: no limit
  std::string max_wear = "0.005 mm";  ///< --max-wear: a length
  bool resume = false;                ///< --resume
};
struct StudyOptions {
  int jobs = 0;                     ///< --jobs; 0: as many as threads
  std::string shard = "1/1";        ///< --shard
  std::string engine;               ///< --engine; empty: all
  std::vector<std::string> groups;  ///< --group; empty: all
  bool dry_run = false;             ///< --dry-run
  std::string lease = "5 min";      ///< --lease: a time
  bool list = false;                ///< --list
  std::string batch;                ///< --batch: the word of a batch system
  int only = 0;                     ///< --only: from 1; 0: all
  bool wait = true;                 ///< --no-wait: for cases that others compute
};
struct ShakedownOptions {
  std::string engine = "bem";  ///< --engine
  bool single_track = true;    ///< --no-single-track: without the limit for one track, which takes some seconds
  bool maps = false;           ///< limits over traction too: of the command shakedown, which is not in a hurry
};
struct MaterialOptions {
  std::filesystem::path strain, stress;                      ///< --strain, --stress: a path
  std::filesystem::path calibrate, cyclic_curve, monotonic;  ///< --calibrate, --cyclic-curve, --monotonic: tests
  std::filesystem::path shear_yield;                         ///< --shear-yield: points of strained steel
  int increments = 100;                                      ///< --increments
  int cycles = 1;                                            ///< --cycles
  int backstresses = 0;                                      ///< --backstresses; 0: as many as lower the error
  std::string of = "rail";                                   ///< --of
  std::string depth;                                         ///< --depth: a length; empty: the top
};
struct PassesOptions {
  std::string engine = "bem";               ///< --engine
  int passes = 20;                          ///< --passes, since the first one
  bool resume = false;                      ///< --resume
  std::string checkpoint_every = "10 min";  ///< --checkpoint-every: a wall time; fem
  std::string roll_length;                  ///< --roll-length: a length; empty: chosen; fem
  std::string wheels = "new";               ///< --wheels; fem
};
struct ReportOptions {
  std::vector<std::filesystem::path> folders;
  bool reference = true;  ///< --no-reference: without the half-space solution beside a single result
  bool what_if = false;   ///< --what-if: with the explorer on the case
};
struct ValidateOptions {
  std::vector<std::string> sets;
  bool all = false;            ///< --all
  std::filesystem::path docs;  ///< --docs; empty: none
};
struct ExportOptions {
  std::string to;         ///< --to: the word of a program
  bool friction = false;  ///< --friction: in the deck's contact
};
struct SchemaOptions {
  bool json_schema = false, markdown = false;  ///< neither: the JSON schema
  bool results = false;                        ///< --results: of results instead of cases
};

/// Options that several commands have.
struct CommonOptions {
  std::filesystem::path case_file;     ///< a file, or a folder that holds case.toml; first folder of `compare`
  std::filesystem::path reference;     ///< second folder of `compare`
  std::vector<std::string> overrides;  ///< --set
  std::filesystem::path out;           ///< --out; empty: results/<case name>
  bool force = false;                  ///< --force: write into a folder that is not empty
  std::string cell;                    ///< --cell of the half-space commands: a length; empty: the engine's default
  bool page = true;                    ///< --no-report: without report.html
  bool json = false;                   ///< --json: results on standard output as JSON
  int threads = 1;
  std::vector<std::string> command_line;
};

/// Values from the command line.
struct CommandOptions : CommonOptions {
  RunOptions run;
  CreepCurveOptions creep_curve;
  ReceptanceOptions receptance;
  CreepTableCommandOptions creep_table;
  int usetab_cells = 20;  ///< --cells, along either axis of the ellipse
  SweepCommandOptions sweep;
  WearLoopOptions wear_loop;
  StudyOptions study;
  ShakedownOptions shakedown;
  MaterialOptions material;
  PassesOptions passes;
  ReportOptions report;
  ValidateOptions validate;
  ExportOptions export_to;
  SchemaOptions schema;
};

/// The words of --to.
std::vector<std::string> export_words();

/// A subcommand, defined beside its code in command_<name>.cpp.
struct Command {
  const char *name, *what, *examples;                       ///< of its help and its manual page
  void (*declare)(CLI::App& sub, CommandOptions& options);  ///< adds its options
  ExitCode (*run)(const CommandOptions& options);
  bool among_ranks = false;  ///< may be started by mpirun: `run` shares its work, processes of `study` their cases
};
extern const Command kDemoCommand;
extern const Command kCheckCommand;
extern const Command kMeshCommand;
extern const Command kRunCommand;
extern const Command kBemCommand;
extern const Command kShakedownCommand;
extern const Command kMaterialCommand;
extern const Command kPassesCommand;
extern const Command kCompareCommand;
extern const Command kCreepCurveCommand;
extern const Command kReceptanceCommand;
extern const Command kCreepTableCommand;
extern const Command kUsetabCommand;
extern const Command kSweepCommand;
extern const Command kCollectiveCommand;
extern const Command kWearLoopCommand;
extern const Command kStudyCommand;
extern const Command kReportCommand;
extern const Command kValidateCommand;
extern const Command kExploreCommand;
extern const Command kExportCommand;
extern const Command kSchemaCommand;
extern const Command kInfoCommand;
extern const Command kCompletionCommand;
extern const Command kManualCommand;

// Commands that others end with.
ExitCode command_run(const CommandOptions& options);
ExitCode command_bem(const CommandOptions& options);

}  // namespace railstrata
