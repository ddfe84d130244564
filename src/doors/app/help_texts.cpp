#include "app/help_texts.hpp"

#include <CLI/CLI.hpp>

namespace railstrata {
namespace {

/// "TEXT:{fem,bem}" to its words.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

std::string value_word(const CLI::Option& option, const std::vector<std::string>& choices) {
  if (option.get_items_expected_max() == 0) return "";
  if (!option.get_option_text().empty()) return option.get_option_text();
  if (!choices.empty()) return CLI::detail::join(choices, "|");
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

OptionHelp help_of(const CLI::Option& option) {
  OptionHelp out;
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  if (option.get_positional()) out.names = {option.get_name(true)};
  out.choices = choices_of(option.get_type_name());
  out.value = value_word(option, out.choices);
  out.what = option.get_description();
  out.required = option.get_required();
  out.repeated = option.get_items_expected_max() > 1;
  return out;
}

CommandHelp help_of(const CLI::App& app, const std::string& name) {
  CommandHelp out{name, app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? out.positionals : out.options).push_back(help_of(*option));
  return out;
}

}  // namespace

std::vector<CommandHelp> command_help(const CLI::App& app) {
  std::vector<CommandHelp> out{help_of(app, "")};
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    out.push_back(help_of(*sub, sub->get_name()));
  return out;
}

}  // namespace railstrata
