#include "tables/contact_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "geometry/number_table.hpp"
#include "options/option_table.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct InputLine {
  int number = 0;
  std::string text;
};

struct InputCase {
  int module = 0, line = 0;
  std::vector<InputLine> lines;
};

/// Numbers and the line where they begin; 0: not given.
struct InputNumbers {
  int line = 0;
  std::vector<double> at;
  double operator[](std::size_t k) const { return k < at.size() ? at[k] : 0; }
};

struct InputProfile {
  int line = 0;
  std::string file;
  InputNumbers options;  ///< MIRRORY, SCALE, SMOOTH, MIRRORZ, PRFOPT
};

/// Three rows of digits.
enum InputRow { kControl, kOptions, kOutput };
constexpr std::array<const char*, 3> kInputRows{"C-P-B-T-N-F-S", "V-L-D-C-M-Z-E", "X-H-G-I-A-O-W-R"};

/// What cases keep from those before them, and the digits of the last.
struct InputState {
  std::array<InputNumbers, 3> digits;
  int law = 0, discretisation = 2;
  InputNumbers friction, materials, film, grid, heat;
  InputNumbers track, deviation, wheelset, position, velocity, bending;
  InputProfile rail, wheel;
  int digit(InputRow row, std::size_t place) const { return static_cast<int>(digits[row][place]); }
};

struct DigitRule {
  InputRow row;
  std::size_t place;
  const char* name;
  std::string_view taken;
  const char* reason;
  const char* remedy;
};

constexpr const char* kLibrary = "CONTACT's interface may answer it: docs/contact-interface.md";

constexpr DigitRule kDigitRules[] = {
    {kControl, 0, "CONFIG", "01", "a roller below the wheel", "write a case with geometry.rail_radius"},
    {kControl, 2, "BOUND", "0", "an approximate pressure or traction bound", "write B = 0"},
    {kControl, 3, "TANG", "03", "a shift or transient rolling", "write T = 3, or a case with a [transient]"},
    {kControl, 4, "NORM", "1", "the height of the wheelset in place of its load",
     "write N = 1 and FZ, the force that CONTACT prints"},
    {kControl, 5, "FORCE", "01", "a rail on springs or both forces along the surface", kLibrary},
    {kOptions, 0, "VARFRC", "0", "friction that varies", "write V = 0 and a case with friction.lateral_table"},
    {kOptions, 3, "INFLCF", "012", "influence numbers of other bodies than half-spaces", "write C = 2"},
    {kOptions, 5, "ZTRACK", "0123", "unknown", "write Z = 0 to 3"},
    {kOptions, 6, "EWHEEL", "012345", "unknown", "write E = 0 to 5"},
};

/// "12d" are degrees, "0.2r" radians, "1d-3" a number of Fortran's.
std::optional<double> input_number(const std::string& word) {
  const bool angle = word.size() > 1 && word.find_last_not_of("+-.0123456789") == word.size() - 1 &&
                     word.find_first_not_of("+-.0123456789") == word.size() - 1;
  const char unit = angle ? word.back() : ' ';
  if (unit != 'd' && unit != 'D' && unit != 'r' && unit != 'R') return number_of(word);
  const std::optional<double> number = number_of(word.substr(0, word.size() - 1));
  if (!number) return number;
  return unit == 'd' || unit == 'D' ? *number * std::numbers::pi / 180 : *number;
}

/// The numbers before the first word of a line.
std::vector<double> leading_numbers(const std::string& line) {
  std::vector<double> out;
  for (const std::string& word : split_words(line)) {
    const std::optional<double> number = input_number(word);
    if (!number) break;
    out.push_back(*number);
  }
  return out;
}

/// The number of a line "1 MODULE".
std::optional<int> module_of(const std::string& line) {
  const std::vector<std::string> words = split_words(line);
  if (words.size() < 2 || words[0].size() != 1 || words[0][0] < '0' || words[0][0] > '9') return {};
  std::string word = words[1].substr(0, 6);
  for (char& c : word) c = static_cast<char>(c & ~0x20);
  return word == "MODULE" ? std::optional(words[0][0] - '0') : std::nullopt;
}

/// A case that begins with its digits is of the module before it.
std::vector<InputCase> cases_of(const std::string& text) {
  std::vector<InputCase> out;
  std::istringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line = std::string(trimmed(line.substr(0, line.find('%'))));
    if (line.empty()) continue;
    if (const std::optional<int> module = module_of(line)) {
      if (*module == 0) break;
      out.push_back({*module, number, {}});
      continue;
    }
    if (out.empty()) continue;
    if (line.find("P-B-T-N-F-S") != std::string::npos && !out.back().lines.empty())
      out.push_back({out.back().module, number, {}});
    out.back().lines.push_back({number, line});
  }
  return out;
}

class InputReader {
 public:
  InputReader(const fs::path& file, const InputCase& from) : file_(file), case_(from) {}

  InputState read(InputState state) {
    for (const InputRow row : {kControl, kOptions, kOutput}) state.digits[row] = digits(row);
    if (state.digit(kOutput, 0) > 0) next("the digits of PSFLRIN");
    solver(state.digit(kOutput, 2));
    friction(state);
    materials(state);
    if (state.digit(kOutput, 1) == 3) state.heat = take(8, "heat capacity, conductivity and density of both bodies");
    if (state.digit(kOptions, 2) >= 2) {
      state.discretisation = state.digit(kOptions, 2);
      state.grid = take(6, "DX, DS, DQREL, A_SEP, D_SEP, D_COMB");
    }
    track(state);
    wheelset(state);
    return state;
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& what, const std::string& remedy) const {
    refuse_in_table(file_, line, what, remedy);
  }

  const InputLine& next(const char* what) {
    if (at_ == case_.lines.size())
      refuse(case_.lines.empty() ? case_.line : case_.lines.back().number, fmt::format("the case ends before {}", what),
             "compare it with CONTACT's user guide");
    return case_.lines[at_++];
  }

  InputNumbers digits(InputRow row) {
    const InputLine& line = next(kInputRows[row]);
    std::string word = line.text.substr(0, line.text.find_first_of(" \t"));
    const std::size_t count = row == kOutput ? 8 : 7;
    if (word.size() > 8 || word.find_first_not_of("0123456789") != std::string::npos)
      refuse(line.number, fmt::format("\"{}\" are not the digits {}", word, kInputRows[row]),
             "write a digit for each, without blanks");
    word.insert(0, 8 - word.size(), '0');
    InputNumbers out{line.number, {}};
    for (const char c : word.substr(8 - count)) out.at.push_back(c - '0');
    return out;
  }

  /// All numbers of a line, and of as many more as it takes for so many.
  InputNumbers take(std::size_t least, const char* what) {
    InputNumbers out;
    while (out.at.size() < least) {
      const InputLine& line = next(what);
      const std::vector<double> found = leading_numbers(line.text);
      if (found.empty()) refuse(line.number, fmt::format("no number where {} stand", what), "write them there");
      if (out.line == 0) out.line = line.number;
      out.at.insert(out.at.end(), found.begin(), found.end());
    }
    return out;
  }

  void solver(int digit) {
    constexpr std::array<std::size_t, 6> kMore{0, 0, 4, 4, 2, 0};
    if (digit >= static_cast<int>(kMore.size()))
      refuse(case_.line, fmt::format("GAUSEI = {} is unknown", digit), "write G = 1");
    if (digit == 1) return;
    take(5, "MAXGS, MAXIN, MAXNR, MAXOUT, EPS");
    if (kMore[static_cast<std::size_t>(digit)] > 0)
      take(kMore[static_cast<std::size_t>(digit)], "the relaxation of the solver");
  }

  void friction(InputState& state) {
    const int law = state.digit(kOptions, 1);
    if (law == 1) return;
    constexpr std::array<std::size_t, 6> kCount{2, 0, 7, 7, 7, 3};
    if (state.digit(kOptions, 0) > 0 || law > 5 || law == 2)
      refuse(
          state.digits[kOptions].line,
          fmt::format("VARFRC = {}, FRCLAW = {}: friction that a case does not have, that of [friction] is Coulomb's "
                      "or falls with the slip velocity",
                      state.digit(kOptions, 0), law),
          "write V = 0 and L = 0, 3, 4 or 5");
    state.law = law;
    state.friction = take(kCount[static_cast<std::size_t>(law)], "the numbers of friction");
  }

  void materials(InputState& state) {
    const int digit = state.digit(kOptions, 4);
    if (digit != 0 && digit != 4)
      refuse(state.digits[kOptions].line,
             fmt::format("MATER = {}: a case has elastic bodies and a film (M = 0, 4)", digit), kLibrary);
    if (state.digit(kOptions, 3) < 2) return;
    state.materials = take(4, "POISS 1, 2 and GG 1, 2");
    state.film = digit == 4 ? take(4, "GG3, LAYTHK, TAU_C0, K_TAU") : InputNumbers{};
  }

  InputProfile profile() {
    const InputLine& line = next("the name of a profile");
    const std::size_t end = line.text.find('\'', 1);
    if (line.text[0] != '\'' || end == std::string::npos)
      refuse(line.number, "no name of a profile in quotes", "write 'NAME', MIRRORY, SCALE, SMOOTH");
    InputProfile out{
        line.number, line.text.substr(1, end - 1), {line.number, leading_numbers(line.text.substr(end + 1))}};
    std::replace(out.file.begin(), out.file.end(), '\\', '/');
    if (out.options[4] >= 1) take(5, "ISMOOTH and the angles of kinks");
    if (out.options[4] >= 2) next("more options of the profile");
    return out;
  }

  void track(InputState& state) {
    const int digit = state.digit(kOptions, 5);
    if (digit == 1 || digit == 3) state.track = take(4, "GAUGHT, GAUGSQ, GAUGWD, CANT");
    if (digit == 3) state.rail = profile();
    if (digit >= 2) state.deviation = take(6, "DY, DZ, ROLL, VY, VZ, VROLL");
    if (digit >= 2 && state.digit(kControl, 5) == 3) take(4, "the springs of the rail");
  }

  void wheelset(InputState& state) {
    const int digit = state.digit(kOptions, 6);
    if (digit == 3 || digit == 5) {
      state.wheelset = take(3, "FBDIST, FBPOS, NOMRAD");
      state.wheel = profile();
    }
    if (digit >= 1) state.position = take(6, "S, Y, FZ, ROLL, YAW, PITCH");
    if (digit >= 2) state.velocity = take(6, "VS, VY, VZ, VROLL, VYAW, VPITCH");
    if (digit >= 2) state.bending = digit >= 4 ? take(12, "the wheelset's flexibility") : InputNumbers{};
  }

  const fs::path& file_;
  const InputCase& case_;
  std::size_t at_ = 0;
};

/// A case in the making: tables with keys, each with the line it comes from.
class CaseWriter {
 public:
  CaseWriter(const ContactInputName& name, const InputState& state) : name_(name), s_(state) {}

  ContactInput write(int number, std::size_t count) {
    refuse_digits();
    out_.case_text = fmt::format("# CONTACT's case {} of {}\n[case]\ntitle = {}\n", number, count,
                                 toml_quoted(fmt::format("{}, case {}", file_name(), number)));
    if (count > 1 && name_.number == 0)
      note("case {0} of {1} was read; {2}#{0} to {2}#{1} name one", number, count, file_name());
    geometry();
    motion();
    surfaces();
    if (!wrong_.empty()) throw CaseError(std::move(wrong_));
    return std::move(out_);
  }

 private:
  template <class... A>
  void note(fmt::format_string<A...> text, A&&... values) {
    out_.notes.push_back(fmt::format(text, std::forward<A>(values)...));
  }
  void wrong(int line, const std::string& what, const std::string& remedy) {
    wrong_.push_back({fmt::format("{}:{}", name_.file.string(), line), what, remedy});
  }
  std::string file_name() const { return name_.file.filename().string(); }
  void table(const char* name) { out_.case_text += fmt::format("\n[{}]\n", name); }
  void put(const char* key, const std::string& value, int line) {
    out_.case_text += fmt::format("{} = {}  # line {}\n", key, value, line);
  }
  void put(const char* key, double value, const char* unit, int line) {
    const double number = value + 0.0;  // no -0
    put(key, *unit == '\0' ? fmt::format("{}", number) : fmt::format("\"{} {}\"", number, unit), line);
  }

  void refuse_digits() {
    for (const DigitRule& rule : kDigitRules) {
      const int value = s_.digit(rule.row, rule.place);
      if (rule.taken.find(static_cast<char>('0' + value)) == std::string_view::npos)
        wrong(s_.digits[rule.row].line, fmt::format("{} = {}: {}", rule.name, value, rule.reason), rule.remedy);
    }
    for (const auto& [numbers, what] : {std::pair{&s_.track, "the track (Z = 3)"},
                                        {&s_.wheelset, "a wheelset (E = 3)"},
                                        {&s_.position, "a position (E = 1)"},
                                        {&s_.velocity, "a velocity (E = 2)"},
                                        {&s_.friction, "friction (L = 0)"},
                                        {&s_.materials, "materials (C = 2)"}})
      if (numbers->line == 0)
        wrong(s_.digits[kControl].line, fmt::format("neither this case nor one before it gives {}", what),
              "give it with its digit");
    if (s_.rail.line == 0 && s_.track.line != 0)
      wrong(s_.track.line, "no case gives the rail's profile", "write Z = 3 once");
    if (!wrong_.empty()) throw CaseError(std::move(wrong_));
  }

  double side() const { return s_.digit(kControl, 0) == 0 ? -1 : 1; }
  double tape_circle() const { return 0.5 * s_.wheelset[0] - s_.wheelset[1]; }
  double radius() const { return s_.wheelset[2]; }

  void put_profile(const char* body, const InputProfile& profile) {
    const fs::path file(profile.file);
    const std::string ending = file.extension().string();
    if (ending == ".slcs" || ending == ".slcw")
      wrong(profile.line, fmt::format("{}: profiles that vary along the track or around the wheel", profile.file),
            "name one profile of the list");
    const double scale = profile.options[1];
    if (scale != 0 && scale != 1 && scale != 25.4 && scale != 1000)
      wrong(profile.line, fmt::format("SCALE = {} is no unit of length in millimetres", scale), "scale the file");
    if (profile.options[2] > 0)
      note("SMOOTH = {} of {} was left out: a case smooths a profile by the scatter of its points", profile.options[2],
           profile.file);
    put(fmt::format("{}_profile", body).c_str(), toml_quoted(profile.file), profile.line);
    if (profile.options[0] >= 1) put(fmt::format("{}_mirror", body).c_str(), "true", profile.line);
  }

  void geometry() {
    const InputNumbers &t = s_.track, &d = s_.deviation, &p = s_.position;
    table("geometry");
    put_profile("rail", s_.rail);
    put_profile("wheel", s_.wheel);
    if (!(t[0] > 0) || t[1] > 1)
      wrong(t.line, fmt::format("GAUGHT = {}, GAUGSQ = {}: a case places a rail by its first gauge face", t[0], t[1]),
            "give GAUGHT and GAUGWD, the depth where the gauge is measured and the gauge");
    for (const std::size_t k : {2u, 3u, 4u, 5u})
      if (d[k] != 0)
        wrong(d.line, "ROLL, VY, VZ, VROLL of the rail: a case has a rail at rest, inclined by its cant",
              "write 0, or add ROLL to CANT");
    for (const double value : s_.bending.at)
      if (value != 0) {
        wrong(s_.bending.line, "a flexible wheelset: a case has a rigid one", "write E = 3 or 2");
        break;
      }
    put("gauge_depth", t[0], "mm", t.line);
    put("gauge", t[2], "mm", t.line);
    put("cant", std::tan(t[3]), "", t.line);
    put("back_to_back", s_.wheelset[0], "mm", s_.wheelset.line);
    put("flange_back_to_tape", -s_.wheelset[1], "mm", s_.wheelset.line);
    put("wheel_radius", radius(), "mm", s_.wheelset.line);
    const double roll = side() * p[3], yaw = side() * p[4];
    put("lateral_shift",
        side() * (p[1] - d[0]) + tape_circle() * (std::cos(roll) * std::cos(yaw) - 1) - radius() * std::sin(roll), "mm",
        p.line);
    put("yaw", std::tan(yaw), "", p.line);
    put("roll", -std::tan(roll), "", p.line);
    if (turning() != 0) put("curve_radius", s_.velocity[0] / turning(), "mm", s_.velocity.line);
    if (side() < 0) note("a left wheel: y, roll and yaw were turned to count to its field side");
  }

  /// About the vertical, against the rail, 1/s; positive with the centre on the field side.
  double turning() const { return side() * (s_.velocity[4] + s_.track[4] * s_.velocity[0]); }

  void motion() {
    const InputNumbers& v = s_.velocity;
    const bool slides = s_.digit(kControl, 3) != 0;
    if (!(v[0] > 0)) wrong(v.line, fmt::format("VS = {}: a case rolls forwards", v[0]), "write a speed above 0");
    table("vehicle");
    put("wheel_load", s_.position[2], "N", s_.position.line);
    table("drive");
    put("speed", v[0], "mm/s", v.line);
    if (s_.digit(kControl, 5) == 1) {
      put("tractive_force", -v[5], "N", v.line);
    } else {
      put("creepage", 1 - (turning() * tape_circle() - v[5] * radius() * std::cos(s_.position[4])) / v[0], "", v.line);
      put("creepage_of", "\"wheel\"", v.line);
    }
    if (v[1] != 0 || v[3] != 0)
      put("lateral_creepage", side() * (v[1] - v[3] * radius()) / v[0] - std::tan(side() * s_.position[4]), "", v.line);
    if (v[2] != 0) note("VZ = {} was left out: the wheel follows the rail", v[2]);
    if (!slides) put("friction_coefficient", 0, "", s_.digits[kControl].line);
    if (slides) friction();
  }

  void friction() {
    const InputNumbers& f = s_.friction;
    const bool falls = s_.law == 3 || s_.law == 4, polach = s_.law == 5;
    put("friction_coefficient", falls ? f[0] + f[1] : polach ? f[0] : std::min(f[0], f[1]), "", f.line);
    if (s_.law == 0 && f[0] != f[1]) note("friction is the smaller one of FSTAT = {} and FKIN = {}", f[0], f[1]);
    if (!falls && !polach) return;
    table("friction");
    put("law", s_.law == 3 ? "\"falling_rational\"" : "\"falling_exponential\"", f.line);
    put("kinetic_coefficient", falls ? f[0] : f[0] * f[1], "", f.line);
    put("half_velocity", falls ? f[2] : std::numbers::ln2 / f[2], "mm/s", f.line);
    if (polach) return;
    if (f[3] != 0) wrong(f.line, "a second term of falling friction: a case has one", "write FLIN2 = 0");
    put("memory_distance", f[5], "mm", f.line);
    put("memory_velocity", f[6], "mm/s", f.line);
  }

  void surfaces() {
    const InputNumbers& m = s_.materials;
    for (const std::size_t body : {0u, 1u}) {
      table(body == 0 ? "material.rail" : "material.wheel");
      put("young", 2 * (1 + m[body]) * m[2 + body], "MPa", m.line);
      put("poisson", m[body], "", m.line);
    }
    if (const InputNumbers& film = s_.film; film.line != 0) {
      table("third_body");
      put("shear_modulus", film[0], "MPa", film.line);
      put("thickness", film[1], "mm", film.line);
      if (film[2] > 0) put("yield_shear", film[2], "MPa", film.line);
      if (film[2] > 0) put("hardening", film[3], "MPa/mm", film.line);
    }
    const bool surface_slip = s_.discretisation == 3 || s_.discretisation == 4;
    table("bem");
    put("spin_angle", surface_slip ? "\"local\"" : "\"patch\"", s_.digits[kOptions].line);
    if (s_.discretisation == 4) put("normals", "\"local\"", s_.digits[kOptions].line);
    if (s_.grid.line != 0)
      note("elements of {} mm x {} mm are no part of a case: --cell \"{} mm\" takes them", s_.grid[0], s_.grid[1],
           s_.grid[0]);
    if (s_.heat.line != 0) note("H = 3, temperatures by CONTACT's numbers, was left out");
  }

  const ContactInputName& name_;
  const InputState& s_;
  ContactInput out_;
  std::vector<Diagnostic> wrong_;
};

}  // namespace

std::optional<ContactInputName> contact_input_name(const fs::path& given) {
  const std::string ending = given.extension().string();
  const std::size_t mark = std::min(ending.find('#'), ending.size());
  std::string form = ending.substr(0, mark);
  for (char& c : form) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 0x20 : c);
  if (form != ".inp") return {};
  if (mark == ending.size()) return ContactInputName{given, 0};
  ContactInputName out{given.parent_path() / (given.stem().string() + ending.substr(0, mark)), 0};
  const char *begin = ending.data() + mark + 1, *end = ending.data() + ending.size();
  if (const auto [at, error] = std::from_chars(begin, end, out.number);
      error != std::errc() || at != end || out.number < 1)
    throw CaseError(fmt::format("{}: {} is no number of a case", given.string(), ending.substr(mark)),
                    "write e.g. wheel.inp#3");
  return out;
}

ContactInput read_contact_input(const std::string& text, const ContactInputName& name) {
  const std::vector<InputCase> cases = cases_of(text);
  const auto first = std::find_if(cases.begin(), cases.end(), [](const InputCase& c) { return c.module == 1; });
  const auto count = static_cast<std::ptrdiff_t>(cases.size());
  const std::ptrdiff_t wanted = name.number > 0 ? name.number - 1 : first - cases.begin();
  if (first == cases.end())
    throw CaseError("no case of module 1 (wheel on rail)", "basic contacts (module 3) have no wheel and no rail",
                    name.file.string());
  if (wanted >= count)
    throw CaseError(fmt::format("there is no case {}: the number of cases is {}", name.number, count),
                    "count them from #1, basic contacts (module 3) too", name.file.string());
  if (cases[static_cast<std::size_t>(wanted)].module != 1)
    refuse_in_table(name.file, cases[static_cast<std::size_t>(wanted)].line,
                    fmt::format("case {} is of module {}", wanted + 1, cases[static_cast<std::size_t>(wanted)].module),
                    fmt::format("module 1 is wheel on rail: case {} is", first - cases.begin() + 1));
  InputState state;
  for (std::ptrdiff_t k = 0; k <= wanted; ++k)
    if (const InputCase& one = cases[static_cast<std::size_t>(k)]; one.module == 1)
      state = InputReader(name.file, one).read(state);
  return CaseWriter(name, state).write(static_cast<int>(wanted) + 1, cases.size());
}

}  // namespace railstrata
