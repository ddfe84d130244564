#include "app/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/shell_word.hpp"

namespace railstrata {
namespace {

// Where bash splits words at "=", KEY=VALUE reaches the function in pieces: they are put together again, and answers
// are what follows the last "=".
constexpr const char* kFunctions = R"BASH(
# words and word: the line up to the cursor and the word under it, with KEY=VALUE in one piece
_railstrata_read_line() {
  local piece glued=''
  words=()
  for piece in "${COMP_WORDS[@]:0:COMP_CWORD+1}"; do
    if [[ ${#words[@]} -gt 0 && ( $piece == = || -n $glued ) ]]; then
      words[-1]+=$piece
    else
      words+=("$piece")
    fi
    glued=
    [[ $piece == = && ! ${COMP_LINE:0:COMP_POINT} =~ [[:space:]]$ ]] && glued=1
  done
  word=${words[-1]}
}

# _railstrata_answer SUFFIX CANDIDATE...: those that begin with what is there
_railstrata_answer() {
  local begun=$word suffix=$1 candidate quote=''
  shift
  if [[ $word == *=* && $COMP_WORDBREAKS == *=* ]]; then begun=${word#*=}; fi
  case $begun in [\"\']*) quote=${begun:0:1} begun=${begun:1} ;; esac
  begun=${begun//\\ / }
  for candidate; do
    [[ $candidate == "$begun"* ]] || continue
    [[ -n $quote ]] || candidate=${candidate// /\\ }
    COMPREPLY+=("$candidate$suffix")
  done
}

# keys up to their next dot: a case has some hundreds
_railstrata_keys() {
  local key rest index='' begun=$word
  local -A seen=()
  local -a found=()
  if [[ $word =~ ^([a-z]+)\.([0-9]+)\. ]]; then
    index=${BASH_REMATCH[2]}
    begun=${BASH_REMATCH[1]}.0.${word#*.*.}
  fi
  while read -r key; do
    [[ $key == "$begun"* ]] || continue
    rest=${key#"$begun"}
    if [[ $rest == *.* ]]; then key=$begun${rest%%.*}.; else key=$key=; fi
    [[ -n $index ]] && key=${key%%.*}.$index.${key#*.*.}
    [[ -n ${seen[$key]} ]] || found+=("$key")
    seen[$key]=1
  done <<<"$_railstrata_key_names"
  compopt -o nospace 2>/dev/null
  _railstrata_answer '' "${found[@]}"
}

# what may follow KEY=: words, the default, units after a number
_railstrata_values() {
  local key=${word%%=*} value=${word#*=} prefix='' line number
  local -a answers=()
  [[ $key =~ ^([a-z]+)\.[0-9]+\.(.*)$ ]] && key=${BASH_REMATCH[1]}.0.${BASH_REMATCH[2]}
  [[ $COMP_WORDBREAKS == *=* ]] || prefix=${word%%=*}=
  value=${value#[\"\']}
  _railstrata_key_values "$key"
  if [[ $value =~ ^([-+]?[0-9.]+([eE][-+]?[0-9]+)?) ]]; then
    number=${BASH_REMATCH[1]}
    for line in "${units[@]}"; do answers+=("$prefix$number $line"); done
  else
    for line in "${values[@]}"; do answers+=("$prefix$line"); done
  fi
  _railstrata_answer '' "${answers[@]}"
  if [[ $key == *_profile || $key == *_file || $key == *.file ]]; then _railstrata_files; fi
}

_railstrata_files() {
  local file begun=$word
  [[ $word == *=* && $COMP_WORDBREAKS == *=* ]] && begun=${word#*=}
  compopt -o filenames 2>/dev/null
  while IFS= read -r file; do COMPREPLY+=("$file"); done < <(compgen -f -- "$begun")
}

_railstrata() {
  local word command='' before='' k
  local -a words=() values=() units=()
  COMPREPLY=()
  _railstrata_read_line
  for ((k = 1; k < ${#words[@]} - 1; ++k)); do
    case ${words[k]} in
      -j | --threads) ((++k)) ;;
      -* | help) ;;
      *) command=${words[k]} && break ;;
    esac
  done
  if [[ ${#words[@]} -gt 2 ]]; then before=${words[-2]}; fi
  if [[ -z $command && $word != -* ]]; then
    _railstrata_answer '' "${_railstrata_commands[@]}"
    return
  fi
  if [[ $before == --set || $before == --vary ]]; then
    if [[ $word == *=* ]]; then _railstrata_values; else _railstrata_keys; fi
    return
  fi
  if _railstrata_option_values "$command" "$before"; then
    if [[ ${#values[@]} -gt 0 ]]; then _railstrata_answer '' "${values[@]}"; fi
    return
  fi
  if [[ $word == -* ]]; then
    _railstrata_options "$command"
    _railstrata_answer '' "${values[@]}"
  elif _railstrata_words "$command"; then
    _railstrata_answer '' "${values[@]}"
  else
    _railstrata_files
  fi
}
complete -F _railstrata railstrata
)BASH";

std::string array_of(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += fmt::format("{}{}", out.empty() ? "" : " ", shell_word(word));
  return "(" + out + ")";
}

std::vector<std::string> option_names(const CommandHelp& command) {
  std::vector<std::string> out;
  for (const OptionHelp& option : command.options)
    for (const std::string& name : option.names)
      if (name.starts_with("--")) out.push_back(name);
  return out;
}

/// Options whose value is a file or a folder.
bool takes_file(const OptionHelp& option) {
  const auto is = [&](const char* name) {
    return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
  };
  return is("--out") || is("--strain") || is("--stress") || is("--calibrate") || is("--cyclic-curve") ||
         is("--monotonic") || is("--shear-yield") || option.value == "FOLDER";
}

std::string option_functions(const std::vector<CommandHelp>& commands) {
  const CommandHelp& program = commands.front();
  std::string names, values, words;
  for (const CommandHelp& command : commands) {
    std::vector<std::string> all = option_names(command);
    if (!command.name.empty())
      for (const std::string& name : option_names(program))
        if (std::find(all.begin(), all.end(), name) == all.end() && name != "--version") all.push_back(name);
    names += fmt::format("    '{}') values={} ;;\n", command.name, array_of(all));
    for (const OptionHelp& option : command.options) {
      if (option.value.empty() || option.value == "KEY=VALUE" || option.value == "KEY=VALUES") continue;
      const std::string then =
          takes_file(option) ? "_railstrata_files" : fmt::format("values={}", array_of(option.choices));
      const std::string place = command.name.empty() ? "*" : "'" + command.name + "'";
      for (const std::string& name : option.names) values += fmt::format("    {}' {}') {} ;;\n", place, name, then);
    }
    for (const OptionHelp& positional : command.positionals)
      if (!positional.choices.empty())
        words += fmt::format("    '{}') values={} ;;\n", command.name, array_of(positional.choices));
  }
  return fmt::format(
      "\n# values: the options of a command\n_railstrata_options() {{\n  case $1 in\n{}  esac\n}}\n"
      "\n# values: of an option of a command; fails if it takes none\n"
      "_railstrata_option_values() {{\n  case \"$1 $2\" in\n{}    *) return 1 ;;\n  esac\n  return 0\n}}\n"
      "\n# values: what a command takes where it takes words, not files\n"
      "_railstrata_words() {{\n  case $1 in\n{}    *) return 1 ;;\n  esac\n}}\n",
      names, values, words);
}

std::string key_function(const std::vector<CaseKey>& keys) {
  std::string names, values;
  for (const CaseKey& key : keys) {
    names += (names.empty() ? "" : "\n") + key.key;
    std::vector<std::string> words = key.values;
    std::string preset = key.preset;
    std::erase(preset, '"');
    const bool one_word = preset.find_first_of("[{") == std::string::npos;
    if (!preset.empty() && one_word && std::find(words.begin(), words.end(), preset) == words.end())
      words.insert(words.begin(), preset);
    if (words.empty() && key.units.empty()) continue;
    values += fmt::format("    {}) values={} units={} ;;\n", key.key, array_of(words), array_of(key.units));
  }
  return fmt::format(
      "\n_railstrata_key_names='{}'\n\n# values, units: of a key of a case\n_railstrata_key_values() {{\n  case $1 "
      "in\n{}  esac\n}}\n",
      names, values);
}

}  // namespace

std::string bash_completion(const std::vector<CommandHelp>& commands, const std::vector<CaseKey>& keys) {
  std::vector<std::string> names{"help"};
  for (const CommandHelp& command : commands)
    if (!command.name.empty()) names.push_back(command.name);
  return fmt::format(
      "# bash completion of railstrata, written by `railstrata completion bash`\n\n"
      "_railstrata_commands={}\n{}{}{}",
      array_of(names), option_functions(commands), key_function(keys), kFunctions);
}

}  // namespace railstrata
