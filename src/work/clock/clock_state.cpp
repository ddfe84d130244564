#include "clock/clock_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "io/output_folder.hpp"
#include "record/output_file.hpp"
#include "study/study_plan.hpp"

namespace railstrata {

// All that is written is listed here, for writing and reading.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Vec2, y, z)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MetalGrid, from, apart, columns, thickness)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WornSurface, moved, points, day_s, removed, gauge_widening)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(DamageKey, zone, surface, damage)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FirstFailure, traffic, depth, s)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Gathered, damage, failures)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ClockMoment, kilograms, removed, removed_y, gauge_widening, p_max, layer_left,
                                   ductility, ductility_y, ductility_depth, exhausted, cycles, fatigue, net,
                                   contact_change, unsettled, changes, crack, crack_growth)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RailCrack, s, tip, azimuth, begun, detectable, allowable)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ClockResult, history, wheels, tonnes, reached, ended, worn_through, notes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ClockState, grid, metal, metal_removed, surface, damage, kilograms, wheels,
                                   next_grinding, crack, followed, noted, out)

namespace {

constexpr std::size_t kHashed = 66;  // characters of a file's SHA-256 in quotes

/// Values of a resolved case (or lines of its form) by their keys.
std::map<std::string, std::string> values_of(const std::string& text) {
  std::map<std::string, std::string> out;
  std::map<std::string, int> tables;
  std::string table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("[[")) {
      const std::string name = line.substr(2, line.find(']') - 2);
      table = fmt::format("{}.{}.", name, tables[name]++);
    } else if (line.starts_with("[")) {
      table = line.substr(1, line.find(']') - 1) + ".";
    } else if (equals != std::string::npos) {
      out[table + line.substr(0, equals)] = line.substr(equals + 3);
    }
  }
  for (const char* key : {"case.title", "run.device", "life.until"}) out.erase(key);  // no number depends on them
  return out;
}

/// "geometry.cant = 0.05 instead of 0.025"; empty: nothing differs.
std::string differences(const std::string& is, const std::string& was) {
  constexpr std::size_t kShown = 5;
  const std::map<std::string, std::string> now = values_of(is), then = values_of(was);
  const auto value = [](const std::map<std::string, std::string>& of, const std::string& key) {
    const auto at = of.find(key);
    return at == of.end() ? "nothing" : at->second;
  };
  std::map<std::string, std::string> all = now;
  all.insert(then.begin(), then.end());
  std::vector<std::string> out;
  for (const auto& [key, any] : all)
    if (const std::string a = value(now, key), b = value(then, key); a != b)
      out.push_back(a.size() == kHashed && b.size() == kHashed ? key + ": a file of other content"
                                                               : fmt::format("{} = {} instead of {}", key, a, b));
  if (out.size() > kShown) {
    const std::size_t more = out.size() - kShown;
    out.resize(kShown);
    out.push_back(fmt::format("{} more", more));
  }
  return fmt::format("{}", fmt::join(out, "; "));
}

}  // namespace

ClockOptions clock_options(const CaseSpec& spec, const BemOptions& bem, const Control* control) {
  ClockOptions out;
  out.bem = bem;
  out.horizon = spec.life.until;
  out.control = control;
  return out;
}

std::string clock_identity(const LoadedCase& loaded, const ClockOptions& o) {
  return fmt::format(
      "version of results = {}\n--cell = {}\nmax_wear = {}\nchange = {}\nmoved = {}\napart = {}\nfirst_row = {}\n"
      "growth = {}\ntolerance = {}\nmost changes = {}\n{}",
      kResultVersion, o.bem.cell, o.max_wear, o.change, o.moved, o.apart, o.first_row, o.growth, o.settle.tolerance,
      o.settle.changes, case_by_content(loaded));
}

void write_clock_state(const std::filesystem::path& file, const std::string& identity, const ClockState& state) {
  std::string bytes;
  nlohmann::json::to_cbor({{"identity", identity}, {"state", state}}, bytes);
  write_whole_file(file, bytes);
}

ClockState read_clock_state(const std::filesystem::path& file, const std::string& identity, double horizon) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file))
    throw CaseError("there is nothing to resume: no stretch of traffic has been kept", "begin anew with --force", name);
  ClockState state;
  try {
    const nlohmann::json kept = nlohmann::json::from_cbor(file_text(file));
    if (const std::string differs = differences(identity, kept.at("identity")); !differs.empty())
      throw CaseError(fmt::format("this traffic is of another case: {}", differs),
                      "give the case, the --set and the --cell of its beginning, or begin anew with --force", name);
    kept.at("state").get_to(state);
  } catch (const nlohmann::json::exception& e) {
    throw CaseError(fmt::format("the state of the traffic cannot be read: {}", e.what()), "begin anew with --force",
                    name);
  }
  if (state.out.reached > horizon)
    throw CaseError(
        fmt::format("the rail has been followed to {:.6g} Mt, beyond --until", 1e-9 * state.out.reached),
        fmt::format("give --until \"{:.6g} Mt\" or later, or begin anew with --force", 1.001e-9 * state.out.reached),
        name);
  return state;
}

}  // namespace railstrata
