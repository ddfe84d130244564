#include "tables/load_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "options/option_table.hpp"
#include "tables/load_series.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

struct ColumnWord {
  std::string_view key, word;
};
/// Headings of spreadsheets beside the keys: German, French, Swedish, Chinese.
constexpr std::array kColumnWords{ColumnWord{"name", "Name"},
                                  ColumnWord{"name", "Fahrzeug"},
                                  ColumnWord{"name", "Véhicule"},
                                  ColumnWord{"name", "Fordon"},
                                  ColumnWord{"name", "名称"},
                                  ColumnWord{"passages", "Überrollungen"},
                                  ColumnWord{"passages", "Überfahrten"},
                                  ColumnWord{"passages", "Anzahl"},
                                  ColumnWord{"passages", "Nombre"},
                                  ColumnWord{"passages", "Antal"},
                                  ColumnWord{"passages", "通过次数"},
                                  ColumnWord{"mgt", "MGT"},
                                  ColumnWord{"mgt", "Mio. t"},
                                  ColumnWord{"mgt", "总重"},
                                  ColumnWord{"wheel_load", "Q"},
                                  ColumnWord{"wheel_load", "Radlast"},
                                  ColumnWord{"wheel_load", "Charge par roue"},
                                  ColumnWord{"wheel_load", "Hjullast"},
                                  ColumnWord{"wheel_load", "轮重"},
                                  ColumnWord{"axle_load", "Radsatzlast"},
                                  ColumnWord{"axle_load", "Achslast"},
                                  ColumnWord{"axle_load", "Charge par essieu"},
                                  ColumnWord{"axle_load", "Axellast"},
                                  ColumnWord{"axle_load", "轴重"},
                                  ColumnWord{"lateral_shift", "y"},
                                  ColumnWord{"lateral_shift", "Querverschiebung"},
                                  ColumnWord{"lateral_shift", "Déplacement latéral"},
                                  ColumnWord{"lateral_shift", "Sidoförskjutning"},
                                  ColumnWord{"lateral_shift", "横移量"},
                                  ColumnWord{"yaw", "psi"},
                                  ColumnWord{"yaw", "Anlaufwinkel"},
                                  ColumnWord{"yaw", "Gierwinkel"},
                                  ColumnWord{"yaw", "Angle d'attaque"},
                                  ColumnWord{"yaw", "Anloppsvinkel"},
                                  ColumnWord{"yaw", "冲角"},
                                  ColumnWord{"roll", "phi"},
                                  ColumnWord{"roll", "Wankwinkel"},
                                  ColumnWord{"creepage", "Längsschlupf"},
                                  ColumnWord{"creepage", "Glissement longitudinal"},
                                  ColumnWord{"creepage", "Längskryp"},
                                  ColumnWord{"creepage", "纵向蠕滑率"},
                                  ColumnWord{"lateral_creepage", "Querschlupf"},
                                  ColumnWord{"lateral_creepage", "Glissement latéral"},
                                  ColumnWord{"lateral_creepage", "Tvärkryp"},
                                  ColumnWord{"lateral_creepage", "横向蠕滑率"},
                                  ColumnWord{"curve_radius", "Bogenradius"},
                                  ColumnWord{"curve_radius", "Bogenhalbmesser"},
                                  ColumnWord{"curve_radius", "Rayon de courbe"},
                                  ColumnWord{"curve_radius", "Kurvradie"},
                                  ColumnWord{"curve_radius", "曲线半径"},
                                  ColumnWord{"guiding_force", "Y"},
                                  ColumnWord{"guiding_force", "Führungskraft"},
                                  ColumnWord{"t_gamma", "T-gamma"},
                                  ColumnWord{"speed", "Geschwindigkeit"},
                                  ColumnWord{"speed", "Vitesse"},
                                  ColumnWord{"speed", "Hastighet"},
                                  ColumnWord{"speed", "速度"},
                                  ColumnWord{"friction_coefficient", "Reibwert"},
                                  ColumnWord{"friction_coefficient", "Coefficient de frottement"},
                                  ColumnWord{"friction_coefficient", "Friktionskoefficient"},
                                  ColumnWord{"friction_coefficient", "摩擦系数"},
                                  ColumnWord{"traction_coefficient", "Kraftschluss"},
                                  ColumnWord{"traction_coefficient", "Coefficient d'adhérence"},
                                  ColumnWord{"traction_coefficient", "Adhesionskoefficient"},
                                  ColumnWord{"traction_coefficient", "牵引系数"}};

/// A fault of a row.
struct RowFault {
  const char* key;
  std::string message, remedy;
};

std::optional<RowFault> fault_of(const CaseSpec& spec, const LoadSpec& load) {
  constexpr double kTightest = 5;  // m
  const double wheel = spec.vehicle.wheel_mass * spec.vehicle.gravity;
  if (load.wheel_load && *load.wheel_load < wheel)
    return RowFault{
        "wheel_load",
        fmt::format("wheel_load = {}: the wheel itself weighs {}", format_quantity(*load.wheel_load, dimension::kForce),
                    format_quantity(wheel, dimension::kForce)),
        "give more load, or less vehicle.wheel_mass"};
  if (load.curve_radius && !(std::abs(*load.curve_radius) >= kTightest))
    return RowFault{"curve_radius",
                    fmt::format("curve_radius = {}: must be at least {} to either side",
                                format_quantity(*load.curve_radius, dimension::kLength),
                                format_quantity(kTightest, dimension::kLength)),
                    "leave it out where the case's track is meant"};
  const DriveSpec d = with_load(spec, load).drive;
  const double wanted = std::hypot(d.traction().value_or(0), d.lateral_traction_coefficient.value_or(0));
  if (wanted > 0 && wanted >= d.friction_coefficient)
    return RowFault{load.friction_coefficient ? "friction_coefficient" : "traction_coefficient",
                    fmt::format("a traction coefficient of {:.4g} must be below the friction coefficient {}", wanted,
                                d.friction_coefficient),
                    "the wheel would slide: lower the row's traction or raise its friction"};
  if (spec.friction.kinetic_coefficient.value_or(0) > d.friction_coefficient)
    return RowFault{"friction_coefficient",
                    fmt::format("friction_coefficient = {}: must be at least friction.kinetic_coefficient = {}",
                                d.friction_coefficient, *spec.friction.kinetic_coefficient),
                    "friction falls with slip: raise the row's"};
  return std::nullopt;
}

template <class T>
void take(const std::optional<T>& given, T& value) {
  if (given) value = *given;
}
template <class T>
void take(const std::optional<T>& given, std::optional<T>& value) {
  if (given) value = given;
}

void put(const UnitTable::Cell& cell, const Option& option, CaseSpec& spec, std::size_t index) {
  const Slot slot = option.slot(spec, index);
  if (auto* const* text = std::get_if<std::string*>(&slot)) {
    **text = cell.text;
    return;
  }
  if (!cell.number) return;
  const double value = option.derivation ? option.derivation.value(spec, index, *cell.number) : *cell.number;
  if (auto* const* maybe = std::get_if<std::optional<double>*>(&slot))
    **maybe = value;
  else
    *std::get<double*>(slot) = value;
}

}  // namespace

CaseSpec with_load(const CaseSpec& spec, const LoadSpec& load) {
  CaseSpec out = spec;
  out.loads.clear();
  if (load.wheel_load) out.vehicle.set_load(*load.wheel_load);
  take(load.lateral_shift, out.geometry.lateral_shift);
  take(load.yaw, out.geometry.yaw);
  take(load.roll, out.geometry.roll);
  take(load.curve_radius, out.geometry.curve_radius);
  take(load.speed, out.drive.speed);
  take(load.friction_coefficient, out.drive.friction_coefficient);
  if (load.traction_coefficient) out.drive.creepage.reset();
  take(load.traction_coefficient, out.drive.traction_coefficient);
  take(load.creepage, out.drive.creepage);
  if (load.lateral_traction_coefficient) out.drive.lateral_creepage.reset();
  if (load.lateral_creepage) out.drive.lateral_traction_coefficient.reset();
  take(load.lateral_traction_coefficient, out.drive.lateral_traction_coefficient);
  take(load.lateral_creepage, out.drive.lateral_creepage);
  return out;
}

std::string load_name(const CaseSpec& spec, std::size_t index) {
  const std::string& name = spec.loads.at(index).name;
  return name.empty() ? fmt::format("load {}", index + 1) : name;
}

namespace {

/// What a series does not give and the case has instead.
std::string lacking_of(const UnitTable& table, const std::vector<LoadSpec>& samples) {
  const auto without = [&](auto&& gives) {
    return samples.size() - static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), gives));
  };
  const auto named = [&](std::string_view key) {
    return std::any_of(table.columns.begin(), table.columns.end(), [&](const Option* o) { return o->key == key; });
  };
  std::vector<std::string> out;
  const auto look = [&](const char* key, auto&& gives) {
    if (const std::size_t count = without(gives); count == samples.size())
      out.emplace_back(key);
    else if (count > 0)
      out.push_back(fmt::format("{} ({} of {} samples)", key, count, samples.size()));
  };
  look("wheel_load", [](const LoadSpec& l) { return l.wheel_load.has_value(); });
  look("lateral_shift", [](const LoadSpec& l) { return l.lateral_shift.has_value(); });
  look("yaw", [](const LoadSpec& l) { return l.yaw.has_value(); });
  look("creepage", [](const LoadSpec& l) { return l.creepage || l.traction_coefficient; });
  std::string text =
      out.empty() ? "" : fmt::format("; taken from the case, for the table has none: {}", fmt::join(out, ", "));
  if (!named("mgt") && !named("passages")) text += "; without a column passages or mgt every sample is one wheel";
  return text;
}

}  // namespace

std::string read_load_table(const std::string& text, const std::filesystem::path& path, CaseSpec& spec) {
  const std::filesystem::path file = path.filename();
  const OptionTable& options = *find_table("load");
  UnitTableForm form{{}, options.rivals, "a load", "wheel_load [kN], lateral_shift [mm], passages"};
  for (const Option& option : options.options) form.columns.push_back({&option, option.key});
  for (const ColumnWord& w : kColumnWords)
    for (const Option& option : options.options)
      if (option.key == w.key) form.columns.push_back({&option, w.word});
  const bool series = names_series(text);
  form.others = series;
  form.blanks = true;
  form.gravity = spec.vehicle.gravity;
  const UnitTable table = read_unit_table(text, file, form);
  for (const UnitTable::Row& row : table.rows) {
    spec.loads.emplace_back();
    for (const Option& option : options.options)  // in the table's order: mgt counts over the load
      for (std::size_t k = 0; k < row.cells.size(); ++k)
        if (table.columns[k] == &option) put(row.cells[k], option, spec, spec.loads.size() - 1);
    if (const auto fault = fault_of(spec, spec.loads.back()))
      refuse_in_table(file, row.line, fault->message, fault->remedy);
  }
  if (!series) return {};
  const std::size_t samples = spec.loads.size();
  const std::string lacking = lacking_of(table, spec.loads);
  spec.loads = binned(spec.loads, spec.collective.bin_scale);
  std::vector<std::string> unread = table.ignored;
  std::erase_if(unread, [](const std::string& name) { return names_way(name); });
  std::string note =
      fmt::format("{}: {} samples of a wheel became {} loads{}{}{}", file.string(), samples, spec.loads.size(),
                  unread.empty() ? "" : "; not read: ", fmt::join(unread, ", "), lacking);
  const auto lacks = [](const LoadSpec& l) { return !l.lateral_creepage && !l.lateral_traction_coefficient; };
  if (std::any_of(spec.loads.begin(), spec.loads.end(), lacks))
    note +=
        "; without a column lateral_creepage the yaw alone slides the wheel sideways, which doubles T-gamma where the "
        "wheel moves across as it turns";
  if (std::none_of(spec.loads.begin(), spec.loads.end(), [](const LoadSpec& l) { return l.roll.has_value(); }))
    note += "; without a column roll, and y of the tread, forces of wheels that touch tread and flange are others";
  if (spec.drive.creepage_of == CreepageOf::contact &&
      std::any_of(spec.loads.begin(), spec.loads.end(), [](const LoadSpec& l) { return l.creepage.has_value(); }))
    note +=
        "; its creepages are taken for those of the contact that touches first: give drive.creepage_of = \"wheel\" and "
        "(V - omega r0) / V where wheels touch tread and flange";
  return note;
}

void check_loads(const CaseSpec& spec, CaseSource& source) {
  for (std::size_t i = 0; i < spec.loads.size(); ++i) {
    const std::string name = fmt::format("load.{}", i);
    if (!source.has(name) || !source.sound({name})) continue;
    if (const auto fault = fault_of(spec, spec.loads[i]))
      source.complain(fmt::format("{}.{}", name, fault->key), fmt::format("{}: {}", name, fault->message),
                      fault->remedy);
  }
}

}  // namespace railstrata
