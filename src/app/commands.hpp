#pragma once
// The subcommands. Each reads its case, calls the rooms below and prints; exceptions carry faults to program.cpp.
#include <filesystem>
#include <string>
#include <vector>

#include "case/case_file.hpp"
#include "core/faults.hpp"

namespace railstrata {

/// What the command line says.
struct CommandOptions {
  std::filesystem::path case_file;        ///< a file, or a folder that holds case.toml
  std::vector<std::string> overrides;     ///< --set
  std::filesystem::path out;              ///< --out; empty: results/<case name>
  bool force = false;                     ///< --force: write into a folder that is not empty
  bool json = false;                      ///< --json: results on standard output as JSON
  bool markdown = false, schema = false;  ///< of `schema`
  std::string cell;                       ///< --cell of the half-space commands: a length; empty: the engine's default
  std::filesystem::path reference;        ///< second folder of `compare`
  std::vector<std::filesystem::path> folders;  ///< of `report`
  std::filesystem::path resume;                ///< --resume of `run`: a result folder with a checkpoint
  std::string checkpoint_every = "10 min", max_time = "never";  ///< --checkpoint-every, --max-time of `run`: wall times
  bool report = true;                                           ///< --no-report of `run`, `bem` and `study`
  bool reference_solution = true;                               ///< --no-reference of `report`
  std::vector<std::string> vary;                                ///< --vary of `sweep`
  bool stresses = false;                                        ///< --stresses of `sweep`
  double largest_creepage = 0.02;                               ///< --largest of `creep-curve`
  int points = 21;                                              ///< --points of `creep-curve`
  int jobs = 0;                                                 ///< --jobs of `study`; 0: as many as threads
  std::string shard = "1/1";                                    ///< --shard of `study`
  std::string engine;                                           ///< --engine of `study`; empty: all
  std::vector<std::string> groups;                              ///< --group of `study`; empty: all
  bool dry_run = false;                                         ///< --dry-run of `study`
  int threads = 1;
  std::vector<std::string> command_line;
};

ExitCode command_demo(const CommandOptions& options);
ExitCode command_check(const CommandOptions& options);
ExitCode command_mesh(const CommandOptions& options);
ExitCode command_run(const CommandOptions& options);
ExitCode command_bem(const CommandOptions& options);
ExitCode command_compare(const CommandOptions& options);
ExitCode command_creep_curve(const CommandOptions& options);
ExitCode command_sweep(const CommandOptions& options);
ExitCode command_study(const CommandOptions& options);
ExitCode command_report(const CommandOptions& options);
ExitCode command_schema(const CommandOptions& options);
ExitCode command_info(const CommandOptions& options);

/// The case with the overrides applied; its notes are logged.
LoadedCase load_case_of(const CommandOptions& options);

/// --out, or results/<case name><suffix>.
std::filesystem::path output_folder_of(const CommandOptions& options, const LoadedCase& loaded,
                                       const std::string& suffix = {});

}  // namespace railstrata
