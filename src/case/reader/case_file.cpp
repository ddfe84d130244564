#include "reader/case_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/nearest_word.hpp"
#include "core/text.hpp"
#include "geometry/profile_names.hpp"
#include "options/option_table.hpp"
#include "reader/case_tree.hpp"
#include "reader/wheel_files.hpp"
#include "rules/case_rules.hpp"
#include "rules/irregularity_rules.hpp"
#include "rules/support.hpp"
#include "rules/track_facts.hpp"
#include "tables/contact_input.hpp"
#include "tables/history_table.hpp"
#include "tables/load_rows.hpp"
#include "text/case_source.hpp"
#include "text/text_file.hpp"

namespace railstrata {
namespace {

bool is_builtin(ProfileKind kind, const std::string& name) {
  if (names_primitive(name)) return true;
  for (const std::string& known : builtin_profile_names(kind))
    if (edit_distance(known, name) == 0) return true;
  return false;
}

/// A built-in name stays; a file becomes an absolute path, so that the resolved case means the same from any folder.
void resolve_profile(ProfileKind kind, const char* key, std::string& name, LoadedCase& loaded, CaseSource& source) {
  if (is_builtin(kind, name)) return;
  std::error_code error;  // a name too long, a folder that may not be read: no file to us
  const std::filesystem::path file =
      name.empty() ? loaded.folder() : std::filesystem::absolute(loaded.folder() / name, error).lexically_normal();
  const bool nameable = !name.empty() && name.find('\0') == std::string::npos;
  if (nameable && std::filesystem::is_regular_file(file, error)) {
    name = file.string();
    loaded.inputs.push_back(file);
    return;
  }
  const std::vector<std::string> names = builtin_profile_names(kind);
  const std::string near = likely_profile(kind, name);
  source.complain(fmt::format("geometry.{}", key),
                  fmt::format("geometry.{} = {}: neither a built-in profile nor a file{}", key, toml_quoted(name),
                              nameable ? fmt::format(" (looked for {})", file.string()) : ""),
                  fmt::format("{}built in: {}, arc:R=300 mm",
                              near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near), fmt::join(names, ", ")));
}

/// The columns of transient.history_file take the place of its name.
void read_history(LoadedCase& loaded, CaseSource& source) {
  std::string& name = loaded.spec.transient.history_file;
  if (name.empty() && !source.has(kHistoryFile)) return;
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    source.complain(kHistoryFile, fmt::format("transient.history_file = {}: {}", toml_quoted(name), what), remedy);
  };
  if (name.empty() || name.find('\0') != std::string::npos)
    return refuse("not a file's name", "name a CSV file, relative to the case file");
  std::error_code error;
  const std::filesystem::path said = loaded.folder() / name,
                              file = std::filesystem::absolute(said, error).lexically_normal();
  const std::string text = [&] {
    try {
      return read_text_file(file, "name a CSV file, relative to the case file", &loaded.notes);
    } catch (const CaseError& e) {
      for (const Diagnostic& d : e.diagnostics)
        refuse(fmt::format("{}{}{}", d.where, d.where.empty() ? "" : ": ", d.message), d.remedy);
      return std::string();
    }
  }();
  name.clear();
  if (!source.sound({kHistoryFile})) return;
  loaded.inputs.push_back(file);
  try {
    const auto [lines, notes] = read_history_table(text, said, loaded.spec);
    loaded.notes.insert(loaded.notes.end(), notes.begin(), notes.end());
    for (const GivenColumn& column : given_columns(loaded.spec))
      for (std::size_t row = 0; row < lines.size(); ++row)
        source.remember_origin(fmt::format("transient.{}{}", column.key, row == 0 ? "" : fmt::format(".{}", row)),
                               fmt::format("{}:{}", said.string(), lines[row]));
  } catch (const CaseError& e) {
    for (const Diagnostic& d : e.diagnostics) source.complain_elsewhere(kHistoryFile, d);
  }
}

constexpr const char* kLoadFile = "collective.file";

/// The rows of the table that `name` names take its place: read(text, file) gives a note or an empty text.
template <class Read>
void read_table_file(const std::string& key, std::string& name, LoadedCase& loaded, CaseSource& source, Read&& read) {
  if (name.empty() && !source.has(key)) return;
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    source.complain(key, fmt::format("{} = {}: {}", key, toml_quoted(name), what), remedy);
  };
  if (name.empty() || name.find('\0') != std::string::npos)
    return refuse("not a file's name", "name a CSV file, relative to the case file");
  std::error_code error;
  const std::filesystem::path file = std::filesystem::absolute(loaded.folder() / name, error).lexically_normal();
  try {
    const std::string note =
        read(read_text_file(file, "name a CSV file, relative to the case file", &loaded.notes), file);
    if (!note.empty()) loaded.notes.push_back(note);
    loaded.inputs.push_back(file);
  } catch (const CaseError& e) {
    for (const Diagnostic& d : e.diagnostics)
      refuse(fmt::format("{}{}{}", d.where, d.where.empty() ? "" : ": ", d.message), d.remedy);
  }
  name.clear();
}

void read_height_files(LoadedCase& loaded, CaseSource& source) {
  CaseSpec& spec = loaded.spec;
  for (std::size_t i = 0; i < spec.irregularities.size(); ++i)
    if (std::string* const name = file_of_heights(spec.irregularities[i]))
      read_table_file(fmt::format("irregularity.{}.file", i), *name, loaded, source,
                      [&](const std::string& text, const std::filesystem::path& file) {
                        return read_heights(text, file, spec, i);
                      });
}

/// Whether the case itself gives how wheels are driven along.
bool gives_traction(const CaseSource& source) {
  constexpr std::array kKeys{"drive.traction_coefficient", "drive.tractive_force", "drive.creepage",
                             "drive.wheel_rotation"};
  return std::any_of(kKeys.begin(), kKeys.end(), [&](const char* key) { return source.has(key); });
}

void read_load_rows(LoadedCase& loaded, CaseSource& source);

/// The rows of a collective stand in the case or in a file. Where [drive] gives no traction its wheels roll free: the
/// default of [drive] is that of one driven wheel, not of the traffic's.
void read_loads(LoadedCase& loaded, CaseSource& source) {
  if (gives_traction(source)) return read_load_rows(loaded, source);
  CaseSpec& spec = loaded.spec;
  const double one_wheel = std::exchange(spec.drive.traction_coefficient, 0);
  read_load_rows(loaded, source);
  if (spec.loads.empty()) spec.drive.traction_coefficient = one_wheel;
  const auto free = std::count_if(spec.loads.begin(), spec.loads.end(),
                                  [](const LoadSpec& load) { return !load.traction_coefficient && !load.creepage; });
  if (free > 0)
    loaded.notes.push_back(
        fmt::format("{} of {} loads roll free (traction_coefficient = 0): neither they nor [drive] give a traction, a "
                    "creepage or a force",
                    free, spec.loads.size()));
}

void read_load_rows(LoadedCase& loaded, CaseSource& source) {
  CaseSpec& spec = loaded.spec;
  if (!spec.loads.empty() && source.has(kLoadFile)) {
    source.complain(kLoadFile, "the case has rows of [[load]] and collective.file",
                    "keep one of them: the file's rows may be written as [[load]]");
    spec.collective.file.clear();
    return;
  }
  read_table_file(
      kLoadFile, spec.collective.file, loaded, source, [&](const std::string& text, const std::filesystem::path& file) {
        std::vector<int> lines;
        std::string note = read_load_table(text, file, spec, &lines);
        for (std::size_t i = 0; i < spec.loads.size(); ++i)
          source.remember_origin(
              fmt::format("load.{}.wheel_profile", i),
              i < lines.size() ? fmt::format("{}:{}", file.filename().string(), lines[i]) : file.filename().string());
        return note;
      });
}

/// The wheels of a row that names a profile: a built-in one or none stays none, a file is one, folders and lists are
/// many.
std::vector<WheelShare> find_wheels(const std::string& name, const std::string& key, const LoadedCase& loaded,
                                    CaseSource& source) {
  if (name.empty() || is_builtin(ProfileKind::wheel, name)) return {};
  std::error_code error;
  const std::filesystem::path file = std::filesystem::absolute(loaded.folder() / name, error).lexically_normal();
  const bool nameable = name.find('\0') == std::string::npos;
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    source.complain(key, fmt::format("{} = {}: {}", key, toml_quoted(name), what), remedy);
  };
  try {
    if (nameable && std::filesystem::is_directory(file, error)) return measured_wheels(file);
    if (nameable && std::filesystem::is_regular_file(file, error))
      return file.extension() == ".csv" && lists_wheels(file_text(file)) ? measured_wheels(file)
                                                                         : std::vector<WheelShare>{{file, 1}};
    refuse(fmt::format("neither a built-in profile nor a file nor a folder{}",
                       nameable ? fmt::format(" (looked for {})", file.string()) : ""),
           fmt::format("name a file relative to the folder of the case, or one of {}",
                       fmt::join(builtin_profile_names(ProfileKind::wheel), ", ")));
  } catch (const CaseError& e) {
    for (const Diagnostic& d : e.diagnostics)
      refuse(fmt::format("{}{}{}", d.where, d.where.empty() ? "" : ": ", d.message), d.remedy);
  }
  return {};
}

using RowWheels = std::vector<std::vector<WheelShare>>;

template <class Row>
RowWheels find_wheels(const std::vector<Row>& rows, const char* list, const LoadedCase& loaded, CaseSource& source) {
  RowWheels out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.push_back(find_wheels(rows[i].wheel_profile, fmt::format("{}.{}.wheel_profile", list, i), loaded, source));
  return out;
}

/// A row for each of a row's wheels; `take` gives it its share.
template <class Row, class NameOf, class Take>
void spread_over_wheels(const RowWheels& wheels, std::vector<Row>& rows, const char* made, LoadedCase& loaded,
                        const NameOf& name_of, const Take& take) {
  const bool many = std::any_of(wheels.begin(), wheels.end(), [](const auto& w) { return w.size() > 1; });
  std::vector<Row> all;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    Row row = rows[i];
    if (many) row.name = name_of(i);
    if (wheels[i].empty()) all.push_back(row);
    for (const WheelShare& wheel : wheels[i]) {
      Row& one = all.emplace_back(row);
      one.wheel_profile = wheel.file.string();
      take(one, wheel.share);
      if (wheels[i].size() > 1) one.name = fmt::format("{}, {}", name_of(i), wheel.file.stem().string());
      if (std::find(loaded.inputs.begin(), loaded.inputs.end(), wheel.file) == loaded.inputs.end())
        loaded.inputs.push_back(wheel.file);
    }
    if (wheels[i].size() > 1)
      loaded.notes.push_back(fmt::format("{}: {} wheel profiles make as many {}", name_of(i), wheels[i].size(), made));
  }
  rows = std::move(all);
}

void spread_over_wheels(const RowWheels& of_loads, const RowWheels& of_bogies, LoadedCase& loaded) {
  spread_over_wheels(
      of_loads, loaded.spec.loads, "loads", loaded, [&](std::size_t i) { return load_name(loaded.spec, i); },
      [](LoadSpec& load, double share) { load.passages *= share; });
  std::vector<BogieSpec>& bogies = loaded.spec.collective.curve.bogies;
  spread_over_wheels(
      of_bogies, bogies, "bogies", loaded, [&](std::size_t i) { return bogies[i].title(); },
      [](BogieSpec& bogie, double share) { bogie.mgt = share * bogie.mgt.value_or(0); });
}

/// Where the numbers of kinds of vehicles come from.
void note_types(LoadedCase& loaded) {
  std::set<int> named;
  for (const BogieSpec& bogie : loaded.spec.collective.curve.bogies) {
    if (!named.insert(bogie.type).second) continue;
    const BogieType& type = bogie_types().at(static_cast<std::size_t>(bogie.type));
    loaded.notes.push_back(fmt::format("numbers of bogies of type \"{}\" that are not given: {} ({})", type.name,
                                       certainty_text(type.certainty), type.source));
  }
}

/// The message with its key, if it does not name it itself.
std::string named(const Diagnostic& d) {
  return d.message.find(d.where) == std::string::npos ? fmt::format("{}: {}", d.where, d.message) : d.message;
}

/// A case that was saved before its text, or another file: its defaults were not meant.
void require_keys(const std::string& text, const std::filesystem::path& file) {
  bool empty = true;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string_view said = trimmed(line, " \t\r");
    if (said.starts_with('#') || said.empty()) continue;
    if (said.find('=') != std::string::npos) return;
    empty = empty && said.starts_with('[');
  }
  if (empty)
    throw CaseError("the case file has no key", "write one at least, e.g. title = \"my case\" below [case]",
                    file.string());
}

}  // namespace

LoadedCase parse_case(const std::string& text, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
  LoadedCase loaded;
  loaded.file = file;
  loaded.source_text = text;
  loaded.overrides = overrides;
  CaseSource source(file, text);
  loaded.spec = read_case_tree(source, overrides);
  resolve_profile(ProfileKind::rail, "rail_profile", loaded.spec.geometry.rail_profile, loaded, source);
  resolve_profile(ProfileKind::wheel, "wheel_profile", loaded.spec.geometry.wheel_profile, loaded, source);
  read_history(loaded, source);
  read_loads(loaded, source);
  read_height_files(loaded, source);
  const RowWheels of_loads = find_wheels(loaded.spec.loads, "load", loaded, source),
                  of_bogies = find_wheels(loaded.spec.collective.curve.bogies, "bogie", loaded, source);
  check_case_rules(loaded.spec, source);
  source.finish();
  note_types(loaded);
  spread_over_wheels(of_loads, of_bogies, loaded);
  loaded.resolved_toml = resolved_case(loaded.spec);
  for (IdleSetting& idle : idle_settings(loaded.spec, &source)) {
    if (idle.by && overlooked(*idle.by))
      loaded.idle.push_back(std::move(idle));
    else
      loaded.notes.push_back(std::move(idle.text));
  }
  for (std::string& note : track_notes(loaded.spec, source)) loaded.notes.push_back(std::move(note));
  return loaded;
}

LoadedCase load_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  std::vector<std::string> notes;
  const std::optional<ContactInputName> input = contact_input_name(file);
  const std::filesystem::path& read = input ? input->file : file;
  std::string text = read_text_file(read, "shipped cases stand in cases/, e.g. cases/quick/case.toml", &notes);
  if (input) {
    ContactInput made = read_contact_input(text, *input);
    text = std::move(made.case_text);
    for (const std::string& note : made.notes) notes.push_back(fmt::format("{}: {}", read.filename().string(), note));
  }
  require_keys(text, file);
  LoadedCase loaded = parse_case(text, file, overrides);
  loaded.inputs.insert(loaded.inputs.begin(), read);
  loaded.notes.insert(loaded.notes.begin(), notes.begin(), notes.end());
  return loaded;
}

LoadedCase with_overrides(const LoadedCase& loaded, const std::vector<std::string>& further) {
  std::vector<std::string> all = loaded.overrides;
  all.insert(all.end(), further.begin(), further.end());
  return parse_case(loaded.source_text, loaded.file, all);
}

CaseError in_case_file(const LoadedCase& loaded, const CaseError& error) {
  CaseSource source(loaded.file, loaded.source_text);
  static_cast<void>(read_case_tree(source, loaded.overrides));
  std::vector<Diagnostic> all;
  for (const Diagnostic& d : error.diagnostics)
    if (d.where.empty())
      all.push_back({loaded.file.string(), d.message, d.remedy});
    else
      all.push_back(d.where.find(':') == std::string::npos ? source.diagnosis(d.where, named(d), d.remedy) : d);
  return CaseError(std::move(all));
}

std::vector<Diagnostic> refused_by(const Use& use, const LoadedCase& loaded) {
  std::vector<Diagnostic> all = refused_by(use, loaded.spec);
  return all.empty() ? all : in_case_file(loaded, CaseError(std::move(all))).diagnostics;
}

void require_support(const Use& use, const LoadedCase& loaded) {
  if (std::vector<Diagnostic> all = refused_by(use, loaded); !all.empty()) throw CaseError(std::move(all));
}

std::vector<std::string> notes_for(const Use& use, const LoadedCase& loaded) {
  std::vector<std::string> out = loaded.notes;
  for (const IdleSetting& setting : loaded.idle)
    if (!overlooked(*setting.by, &use)) out.push_back(setting.text);
  for (std::string& note : idle_in(use, loaded.spec)) out.push_back(std::move(note));
  return out;
}

std::vector<std::string> notes_at_rest(const LoadedCase& loaded) {
  std::vector<std::string> out;
  for (const IdleSetting& setting : loaded.idle)
    if (setting.by->key == "run.rolling = false") out.push_back(setting.text);
  return out;
}

std::string resolved_case(const CaseSpec& given) {
  CaseSpec spec = given;
  std::string out;
  for (const OptionTable& table : case_tables())
    for (std::size_t i = 0; i < (table.repeated ? table.repeated.count(spec) : 1); ++i) {
      std::string lines;
      for (const Option& option : table.options)
        if (!option.derivation && (!option.applies || option.applies(spec, i)))
          if (const std::string value = toml_value(option, spec, i); !value.empty())
            lines += fmt::format("{} = {}\n", option.key, value);
      if (lines.empty()) continue;
      out += fmt::format(fmt::runtime(table.repeated ? "{}[[{}]]\n" : "{}[{}]\n"), out.empty() ? "" : "\n", table.name);
      out += lines;
    }
  return out;
}

}  // namespace railstrata
