#include "app/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <new>
#include <system_error>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/mpi_ranks.hpp"
#include "app/processors.hpp"
#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "core/parallel.hpp"
#include "core/printable.hpp"
#include "io/provenance.hpp"
#include "record/escaped_text.hpp"
#include "record/json.hpp"

namespace railstrata {
namespace {

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const Command* c : commands()) names.emplace_back(c->name);
  return names;
}

/// Place of the command among the words; 0: there is none.
std::size_t place_of_command(const std::vector<std::string>& words) {
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "-j" || words[i] == "--threads")
      ++i;
    else if (!words[i].starts_with("-"))
      return i;
  }
  return 0;
}

/// Replaces an old name of a command by today's words and returns a note of it. CLI11 calls an unknown command "extra
/// arguments"; this finds the word that was meant.
std::string use_todays_name(std::vector<std::string>& words) {
  const std::size_t place = place_of_command(words);
  if (place == 0) return {};
  const std::string word = words[place];
  const std::vector<std::string> names = command_names();
  if (std::find(names.begin(), names.end(), word) != names.end()) return {};
  const OldName* old = old_name(word);
  if (old != nullptr && old->now.empty())
    throw CaseError(fmt::format("there is no command {} any more", word),
                    "railstrata help lists the commands, railstrata COMMAND --help the options of one");
  if (old == nullptr) {
    const std::string meant = nearest_word(word, names);
    throw CaseError(fmt::format("unknown command \"{}\"", word),
                    fmt::format("{}commands: {}", meant.empty() ? "" : fmt::format("did you mean {}? ", meant),
                                fmt::join(names, ", ")));
  }
  const std::vector<std::string> now = CLI::detail::split(std::string(old->now), ' ');
  words.erase(words.begin() + static_cast<std::ptrdiff_t>(place));
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(place), now.begin(), now.end());
  return fmt::format("`railstrata {}` is now `railstrata {}`", word, old->now);
}

std::vector<std::string> option_names(const CLI::App& app, const CLI::App* sub) {
  std::vector<std::string> names;
  for (const CLI::App* part : {sub, &app}) {
    if (part == nullptr) continue;
    for (const CLI::Option* option : part->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// The first word that no option or command accepts: an unknown option first, since the words after it belong to it.
std::string first_left_over(const std::vector<std::string>& words, const std::vector<std::string>& left) {
  std::string first;
  for (const std::string& word : words) {
    if (std::find(left.begin(), left.end(), word) == left.end()) continue;
    if (word.starts_with("-")) return word;
    if (first.empty()) first = word;
  }
  return first;
}

CaseError left_over(const CLI::App& app, const CLI::App* sub, const std::string& command,
                    const std::vector<std::string>& words) {
  const std::string word = first_left_over(words, app.remaining(true));
  const bool setting = !word.starts_with("-") && word.find('=') != std::string::npos;
  for (const std::string option : {"--set", "--vary"})
    if (setting && std::find(words.begin(), words.end(), option) != words.end())
      return CaseError(fmt::format("\"{}\" is one word too many for {}", word, command),
                       fmt::format("write {} once for each key: {} {}", option, option, shell_word(word)));
  if (!word.starts_with("-"))
    return CaseError(
        fmt::format("\"{}\" is one word too many for {}", word, command),
        fmt::format("put what has blanks into quotes, e.g. --set mesh.element_size=\"2 mm\"; what it takes: "
                    "{} --help",
                    command));
  const std::vector<std::string> names = option_names(app, sub);
  const std::string option = word.substr(0, word.find('=')), meant = nearest_word(option, names);
  return CaseError(fmt::format("{} has no option {}", command, option),
                   fmt::format("{}options: {}", meant.empty() ? "" : fmt::format("did you mean {}? ", meant),
                               fmt::join(names, ", ")));
}

/// The error, in the program's own words and with a remedy, for a command line that CLI11 refuses. words: the command
/// line; commands: the names of all commands.
CaseError usage_error(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& words,
                      const std::vector<std::string>& commands) {
  const std::vector<const CLI::App*> parsed = app.get_subcommands([](const CLI::App* sub) { return sub->parsed(); });
  const CLI::App* sub = parsed.empty() ? nullptr : parsed.front();
  const auto is = [&](CLI::ExitCodes code) { return e.get_exit_code() == static_cast<int>(code); };
  if (sub == nullptr && is(CLI::ExitCodes::RequiredError))
    return CaseError("no command is given", fmt::format("commands: {}; railstrata help", fmt::join(commands, ", ")));
  const std::string command = sub != nullptr ? "railstrata " + sub->get_name() : "railstrata";
  if (is(CLI::ExitCodes::ExtrasError)) return left_over(app, sub, command, words);
  const std::string what = e.what(), help = fmt::format("what it takes: {} --help", command);
  const std::string name = what.substr(0, what.find(' '));
  const CLI::Option* missing =
      is(CLI::ExitCodes::RequiredError) && sub != nullptr ? sub->get_option_no_throw(name) : nullptr;
  if (missing != nullptr)
    return CaseError(fmt::format("{}: {} is required ({})", command, name, missing->get_description()), help);
  return CaseError(fmt::format("{}: {}", command, what), help);
}

/// "help" becomes "--help", "help run" "run --help".
std::vector<std::string> with_help_spelled_out(std::vector<std::string> words) {
  const auto is_help = [&] { return words.size() > 1 && words[1] == "help"; };
  if (!is_help()) return words;
  while (is_help()) words.erase(words.begin() + 1);
  words.emplace_back("--help");
  return words;
}

/// The text of a line of the log.
class PrintableText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text = printable({message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<PrintableText>(); }
};

void set_up_log(bool quiet, int verbose) {
  const char* plain = std::getenv("NO_COLOR");
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(plain && *plain ? spdlog::color_mode::never
                                                                                    : spdlog::color_mode::automatic);
  auto logger = std::make_shared<spdlog::logger>("railstrata", std::move(sink));
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableText>('*').set_pattern("%^%l:%$ %*");
  logger->set_formatter(std::move(formatter));
  logger->set_level(quiet ? spdlog::level::warn : verbose > 0 ? spdlog::level::debug : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

/// Words are written into JSON and TOML files.
void require_utf8(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    try {
      nlohmann::json(word).dump();
    } catch (const nlohmann::json::type_error&) {
      throw CaseError(fmt::format("\"{}\" is not UTF-8", word), "give files and folders names in UTF-8");
    }
  }
}

/// For messages, which must not fail in their turn.
void say(FILE* stream, const std::string& text) {
  std::fputs(text.c_str(), stream);
  std::fflush(stream);
}

int report(ExitCode code, const std::string& text) {
  say(stderr, printable(fmt::format("error: {}\n", text)));
  return static_cast<int>(code);
}

int report(const CaseError& e, bool json) {
  if (json) {
    auto all = nlohmann::ordered_json::array();
    for (const Diagnostic& d : e.diagnostics)
      all.push_back({{"where", d.where}, {"message", d.message}, {"remedy", d.remedy}});
    say(stdout, json_text(nlohmann::ordered_json{{"errors", all}}, 2) + "\n");
  }
  for (const Diagnostic& d : e.diagnostics)
    say(stderr, printable(fmt::format("{}{}error: {}{}\n", d.where, d.where.empty() ? "" : ": ", d.message,
                                      d.remedy.empty() ? "" : "\n    remedy: " + d.remedy)));
  return static_cast<int>(ExitCode::user);
}

int parse_and_run(const std::vector<std::string>& given, CommandOptions& options) {
  CLI::App app{"RailStrata: rolling contact of a wheel on a layered rail", "railstrata"};
  app.footer(
      "Examples:\n  railstrata check cases/quick\n  railstrata run cases/quick --threads 2\n  railstrata bem "
      "cases/quick\n  railstrata run --help\n\nExit codes: 0 done, 1 a check of the result failed, 2 the input is "
      "wrong, "
      "3 the numbers went wrong, 4 the machine could not, 5 stopped for --max-time (resume it), 70 a fault of the "
      "program, 130 interrupted\n");
  app.set_version_flag("--version", "railstrata " + version_text());
  app.require_subcommand(1);
  app.fallthrough();
  bool quiet = false;
  int verbose = 0;
  options.threads = default_threads();
  app.add_option("-j,--threads", options.threads, "Threads (default: OMP_NUM_THREADS, or one a core)")
      ->check(CLI::Range(1, kMostThreads));
  app.add_flag("--json", options.json, "Results on standard output as JSON");
  app.add_flag("-q,--quiet", quiet, "No progress and no notes: the result, warnings and errors");
  app.add_flag("-v,--verbose", verbose, "More messages");
  std::vector<CommandWork> work;
  for (const Command* c : commands()) {
    CLI::App* sub = app.add_subcommand(c->name, c->what);
    sub->footer(c->examples);
    work.push_back(c->declare(*sub, options));
  }
  require_utf8(given);
  if (given.size() == 1) {  // no mistake to name, and yet nothing done: what there is, and the code of a mistake
    say(stdout, app.help());
    return static_cast<int>(ExitCode::user);
  }
  std::vector<std::string> words = with_help_spelled_out(given);
  const std::string renamed = use_todays_name(words);
  options.command_line = words;
  try {
    std::vector<std::string> reversed(words.rbegin(), words.rend() - 1);
    app.parse(reversed);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // help or version, on standard output
    options.json = std::find(words.begin(), words.end(), "--json") != words.end();
    throw usage_error(app, e, words, command_names());
  }
  set_up_log(quiet, verbose);
  set_threads(options.threads);
  if (!renamed.empty()) spdlog::warn("{}", renamed);
  for (std::size_t k = 0; k < work.size(); ++k) {
    const Command& command = *commands()[k];
    if (!app.got_subcommand(command.name)) continue;
    if (!command.among_ranks) refuse_ranks(command.name);
    return static_cast<int>(work[k]());
  }
  return static_cast<int>(ExitCode::user);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  settle_in();
  CommandOptions options;
  try {
    const int code = parse_and_run({argv, argv + argc}, options);
    if (std::fflush(stdout) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
    if (std::ferror(stdout)) throw std::system_error(EIO, std::generic_category(), "cannot write to standard output");
    return code;
  } catch (const CaseError& e) {
    log_on_rank_0_only();  // a mistake is that of all
    return report(e, options.json);
  } catch (const NumericalError& e) {
    return report(ExitCode::numerics, e.what());
  } catch (const Interrupted& e) {
    return report(ExitCode::interrupted, e.what());
  } catch (const EnvironmentError& e) {
    return report(ExitCode::environment,
                  e.remedy.empty() ? e.what() : fmt::format("{}\n    remedy: {}", e.what(), e.remedy));
  } catch (const std::system_error& e) {  // of a file system, or of standard output
    return report(ExitCode::environment, e.what());
  } catch (const std::bad_alloc&) {
    return report(ExitCode::environment, "not enough memory; `railstrata check` reports what a case needs");
  } catch (const std::exception& e) {
    return report(ExitCode::internal,
                  fmt::format("{} (a fault of the program: please report it with the case file)", e.what()));
  }
}

}  // namespace railstrata
