#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "app/commands.hpp"
#include "app/completion.hpp"
#include "app/help_texts.hpp"
#include "app/manual.hpp"
#include "core/faults.hpp"
#include "io/provenance.hpp"
#include "options/case_schema.hpp"

namespace railstrata {
namespace {

/// As `man` looks for it: FOLDER/man1/railstrata-run.1.
void write_page(const std::filesystem::path& root, const ManualPage& page) {
  const std::filesystem::path folder = root / fmt::format("man{}", page.section);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw EnvironmentError(fmt::format("cannot make {}: {}", folder.string(), error.message()));
  const std::filesystem::path file = folder / fmt::format("{}.{}", page.name, page.section);
  std::ofstream out(file);
  out << page.text;
  out.close();
  if (!out) throw EnvironmentError(fmt::format("cannot write {}", file.string()));
}

void manual(const CLI::App& program, const std::string& wanted, const std::filesystem::path& folder) {
  const std::string name = wanted.empty() ? "railstrata" : "railstrata-" + wanted;
  for (const ManualPage& page : manual_pages(command_help(program), case_keys(), build_info().version)) {
    if (!folder.empty())
      write_page(folder, page);
    else if (page.name == name)
      fmt::print("{}", page.text);
  }
}

void declare_completion(CLI::App& sub, CommandOptions&) {
  const auto shell = std::make_shared<std::string>();
  sub.add_option("shell", *shell, "The shell that reads it")->required()->check(CLI::IsMember({"bash"}));
  sub.final_callback(
      [shell, &sub] { fmt::print("{}", bash_completion(command_help(*sub.get_parent()), case_keys())); });
}

void declare_manual(CLI::App& sub, CommandOptions&) {
  std::vector<std::string> pages{"case"};
  for (const CLI::App* command : sub.get_parent()->get_subcommands([](const CLI::App*) { return true; }))
    pages.push_back(command->get_name());
  const auto page = std::make_shared<std::string>();
  const auto folder = std::make_shared<std::filesystem::path>();
  sub.add_option("page", *page, "A command, or case: the keys of a case (default: the program)")
      ->check(CLI::IsMember(pages));
  sub.add_option("-o,--out", *folder, "Folder for all pages, which go to man1 and man5 there");
  sub.final_callback([page, folder, &sub] { manual(*sub.get_parent(), *page, *folder); });
}

/// Both print what the parser knows of itself, as the last step of parsing.
ExitCode done_by_parsing(const CommandOptions&) { return ExitCode::ok; }

}  // namespace

const Command kCompletionCommand{
    "completion",
    "Print the script that completes commands, options, keys of --set, their words and units in a shell",
    "Examples:\n  source <(railstrata completion bash)\n  railstrata completion bash > "
    "~/.local/share/bash-completion/completions/railstrata\n",
    declare_completion,
    done_by_parsing,
    true};

const Command kManualCommand{
    "manual",
    "Print the manual page of the program, of a command or of case files, or write all of them",
    "Examples:\n  railstrata manual run | man -l -\n  railstrata manual --out ~/.local/share/man\n",
    declare_manual,
    done_by_parsing,
    true};

}  // namespace railstrata
