#include "app/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "core/nearest_word.hpp"
#include "record/escaped_text.hpp"

namespace railstrata {
namespace {

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

}  // namespace

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

std::vector<std::string> with_help_spelled_out(std::vector<std::string> words) {
  const auto is_help = [&] { return words.size() > 1 && words[1] == "help"; };
  if (!is_help()) return words;
  while (is_help()) words.erase(words.begin() + 1);
  words.emplace_back("--help");
  return words;
}

}  // namespace railstrata
