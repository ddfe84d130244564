#include "app/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <sstream>
#include <utility>

namespace railstrata {
namespace {

// Replacements of characters that a terminal without Unicode shows as question marks.
constexpr std::array kPlain{std::pair{"…", "..."}, std::pair{"√", "sqrt "}, std::pair{"±", "+-"}};

/// Text as roff prints it: no request at the start of a line, hyphens that can be copied.
std::string roff(std::string_view text) {
  std::string plain(text);
  for (const auto& [from, to] : kPlain)
    for (std::size_t at = plain.find(from); at != std::string::npos; at = plain.find(from))
      plain.replace(at, std::string_view(from).size(), to);
  std::string out;
  for (const char c : plain) {
    const bool begins = out.empty() || out.back() == '\n';
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string head(const std::string& title, int section, const std::string& version, const std::string& what) {
  const std::string brief = what.substr(0, what.find(". "));
  std::string upper = title;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(".TH {} {} \"\" \"RailStrata {}\" \"{}\"\n.SH NAME\n{} \\- {}\n", roff(upper), section, version,
                     section == 1 ? "User Commands" : "File Formats", roff(title), roff(brief));
}

std::string synopsis_of(const OptionHelp& positional) {
  const std::string word = italic(positional.names.front()) + (positional.repeated ? "..." : "");
  return positional.required ? word : "[" + word + "]";
}

std::string described(const OptionHelp& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += (names.empty() ? "" : ", ") + (name.starts_with("-") ? bold(name) : italic(name));
  const std::string value = option.value.empty() || !option.names.front().starts_with("-") ? "" : option.value;
  return fmt::format(".TP\n{}{}\n{}.\n", names, value.empty() ? "" : " " + italic(value), roff(option.what));
}

std::string options_section(const CommandHelp& command) {
  std::string out;
  for (const std::vector<OptionHelp>* all : {&command.positionals, &command.options})
    for (const OptionHelp& option : *all) out += described(option);
  return out.empty() ? out : ".SH OPTIONS\n" + out;
}

/// "Examples:" with its indented lines, and the paragraphs after it.
std::string footer_sections(const std::string& footer) {
  std::istringstream lines(footer);
  std::string out, line;
  bool example = false;
  const auto close = [&] {
    if (example) out += ".EE\n";
    example = false;
  };
  while (std::getline(lines, line)) {
    if (line == "Examples:") {
      out += ".SH EXAMPLES\n";
    } else if (line.starts_with("  ")) {
      out += (example ? "" : ".EX\n") + roff(line.substr(2)) + "\n";
      example = true;
    } else if (line.empty()) {
      close();
    } else {
      close();
      const bool codes = line.starts_with("Exit codes: ");
      out += codes ? ".SH EXIT STATUS\n" + roff(line.substr(12)) + ".\n" : ".SH NOTES\n" + roff(line) + "\n";
    }
  }
  close();
  return out;
}

std::string see_also(const std::string& name) {
  std::string out = ".SH SEE ALSO\n";
  if (name != "railstrata") out += bold("railstrata") + "(1),\n";
  if (name != "railstrata-case") out += bold("railstrata-case") + "(5),\n";
  return out + "/usr/share/doc/railstrata/README.md.gz\n";
}

ManualPage program_page(const std::vector<CommandHelp>& commands, const std::string& version) {
  const CommandHelp& program = commands.front();
  std::string text = head("railstrata", 1, version, program.what.substr(program.what.find(": ") + 2));
  text += ".SH SYNOPSIS\n.B railstrata\n.I command\n[\\fIargument\\fR...]\n.SH DESCRIPTION\n" + roff(program.what) +
          ".\nA case is a text file with what differs from the defaults; "
          "every command lists its options with \\fB\\-\\-help\\fR.\n.SH COMMANDS\n";
  for (const CommandHelp& command : commands)
    if (!command.name.empty()) text += fmt::format(".TP\n{}\n{}.\n", bold(command.name), roff(command.what));
  return {"railstrata", 1, text + options_section(program) + footer_sections(program.footer) + see_also("railstrata")};
}

ManualPage command_page(const CommandHelp& command, const std::vector<OptionHelp>& of_program,
                        const std::string& version) {
  const std::string name = "railstrata-" + command.name;
  std::string text = head(name, 1, version, command.what);
  text += fmt::format(".SH SYNOPSIS\n.B railstrata {}\n", roff(command.name));
  for (const OptionHelp& positional : command.positionals) text += synopsis_of(positional) + "\n";
  text += "[\\fIoption\\fR...]\n.SH DESCRIPTION\n" + roff(command.what) + ".\n" + options_section(command);
  for (const OptionHelp& option : of_program)
    if (option.names.back() != "--help" && option.names.back() != "--version") text += described(option);
  return {name, 1, text + footer_sections(command.footer) + see_also(name)};
}

ManualPage case_page(const std::vector<CaseKey>& keys, const std::string& version) {
  std::string text = head("railstrata-case", 5, version, "keys of a RailStrata case file");
  text +=
      ".SH DESCRIPTION\nA case is a TOML file. Every key has a default, so a case gives only what differs. A value "
      "with a dimension is a text with its unit: \\(dq0.2 mm\\(dq, \\(dq210 GPa\\(dq.\nOn the command line\n"
      ".B \\-\\-set\n.IR key = value\noverrides a key; those of the first layer are layer.0.key.\n.SH KEYS\n";
  for (const CaseKey& key : keys) {
    text += fmt::format(".TP\n{}\n{}.\n", bold(key.key), roff(key.doc));
    if (!key.allowed.empty()) text += fmt::format("Allowed: {}.\n", roff(key.allowed));
    if (!key.preset.empty()) text += fmt::format("Default: {}.\n", roff(key.preset));
    if (!key.units.empty()) text += fmt::format("Units: {}.\n", roff(fmt::format("{}", fmt::join(key.units, ", "))));
  }
  return {"railstrata-case", 5, text + see_also("railstrata-case")};
}

}  // namespace

std::vector<ManualPage> manual_pages(const std::vector<CommandHelp>& commands, const std::vector<CaseKey>& keys,
                                     const std::string& version) {
  std::vector<ManualPage> out{program_page(commands, version)};
  for (const CommandHelp& command : commands)
    if (!command.name.empty()) out.push_back(command_page(command, commands.front().options, version));
  out.push_back(case_page(keys, version));
  return out;
}

}  // namespace railstrata
