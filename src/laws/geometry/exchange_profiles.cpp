#include "geometry/exchange_profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "core/text.hpp"

namespace railstrata {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return out;
}

/// Calls visit(line, number from 1) for every line without the blanks around it.
template <class Visit>
void each_line(std::string_view text, Visit&& visit) {
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    visit(trimmed(line), number);
  }
}

[[noreturn]] void refuse(const std::string& what, const std::string& remedy, const std::string& name, int line) {
  throw CaseError(what, remedy, line > 0 ? fmt::format("{}:{}", name, line) : name);
}

/// The first two columns of a line, if they are finite numbers.
std::optional<Vec2> point_of(const std::vector<std::string>& words) {
  if (words.size() < 2) return std::nullopt;
  const std::optional<double> y = number_of(words[0]), z = number_of(words[1]);
  if (!y || !z || !std::isfinite(*y) || !std::isfinite(*z)) return std::nullopt;
  return Vec2{*y, *z};
}

void add_point(NumberTable& table, std::string_view line, int number, const std::string& name) {
  const std::vector<std::string> words = split_words(line);
  const std::optional<Vec2> p = point_of(words);
  if (!p) refuse(fmt::format("'{}' is not two finite numbers", line), "remove or repair the point", name, number);
  table.rows.push_back(*p);
  table.lines.push_back(number);
  table.columns = std::max(table.columns, words.size());
}

/// Keeps the points for which `keep(point, last one kept)` holds. Returns how many were dropped.
template <class Keep>
std::size_t keep_points(NumberTable& table, Keep&& keep) {
  std::size_t kept = 0;
  const std::size_t before = table.rows.size();
  for (std::size_t i = 0; i < before; ++i) {
    if (!keep(table.rows[i], kept > 0 ? &table.rows[kept - 1] : nullptr)) continue;
    table.rows[kept] = table.rows[i];
    table.lines[kept++] = table.lines[i];
  }
  table.rows.resize(kept);
  table.lines.resize(kept);
  return before - kept;
}

class Simpack {
 public:
  Simpack(ProfileKind kind, std::string_view text, const std::string& name) : name_(name) {
    std::string section;
    bool listing = false, listed = false;
    each_line(text, [&](std::string_view line, int number) {
      line = trimmed(line.substr(0, line.find_first_of("!%")));
      if (line.empty()) return;
      if (line == "point.begin") {
        if (listed) refuse("there is a second list of points", "keep one spline per file", name_, number);
        listing = listed = true;
      } else if (line == "point.end") {
        listing = false;
      } else if (listing) {
        add_point(table_, line, number, name_);
      } else if (const std::size_t equals = line.find('='); equals != std::string_view::npos) {
        settings_[section + std::string(trimmed(line.substr(0, equals)))] = {
            std::string(trimmed(line.substr(equals + 1))), number};
      } else if (line.ends_with(".begin")) {
        section = std::string(line.substr(0, line.size() - 5));
      } else if (line.ends_with(".end")) {
        section.clear();
      } else {
        refuse(fmt::format("'{}' is not a setting of a Simpack profile", line),
               "write settings as key = value and points between point.begin and point.end", name_, number);
      }
    });
    if (listing)
      refuse("the list of points has no point.end: the file is cut off", "put a whole copy of the file back", name_, 0);
    if (!listed)
      refuse("there is no point.begin in this Simpack profile",
             "export it from Simpack again, or give a file of two columns as .csv", name_, 0);
    if (const double type = value("header.type", kind == ProfileKind::wheel); type != (kind == ProfileKind::wheel))
      refuse(fmt::format("this Simpack profile is for a {}", type == 0 ? "rail" : "wheel"),
             "give rail_profile a .prr file, wheel_profile a .prw file", name_, settings_["header.type"].line);
  }

  NumberTable points() {
    note(fmt::format("Simpack profile of {} points.", table_.rows.size()));
    if (const double least = value("spline.point.dist.min", 0); least > 0)
      note_dropped(keep_points(table_, [&](Vec2 p, const Vec2* last) { return !last || norm(p - *last) >= least; }),
                   "point.dist.min");
    if (const Vec2 shift{value("spline.shift.y", 0), value("spline.shift.z", 0)}; shift.y != 0 || shift.z != 0) {
      for (Vec2& p : table_.rows) p = p + shift;
      note(fmt::format("shift.y = {}, shift.z = {} were added.", shift.y, shift.z));
    }
    if (value("spline.rotate", 0) != 0)
      refuse("rotate turns the points of this Simpack profile", "rotate the points in the file and set rotate = 0",
             name_, settings_["spline.rotate"].line);
    bound("y", [](Vec2 p) { return p.y; });
    bound("z", [](Vec2 p) { return p.z; });
    const double y = mirror("y"), z = mirror("z");
    for (Vec2& p : table_.rows) p = {y * p.y, z * p.z};
    if (value("spline.inversion", 0) != 0) {
      std::reverse(table_.rows.begin(), table_.rows.end());
      std::reverse(table_.lines.begin(), table_.lines.end());
      note("inversion reversed the order of the points.");
    }
    const double per_metre = value("spline.units.len.f", 1000);
    if (!(per_metre > 0))
      refuse("units.len.f must be above 0", "1000 for millimetres, 1 for metres", name_,
             settings_["spline.units.len.f"].line);
    for (Vec2& p : table_.rows) p = (1000 / per_metre) * p;
    if (per_metre != 1000) note(fmt::format("units.len.f = {}: lengths were taken as parts of a metre.", per_metre));
    table_.heading = "mm";
    table_.columns = 2;  // the third is a weight
    if (value("spline.approx.smooth", 0) != 0) note("approx.smooth was not applied.");
    return std::move(table_);
  }

 private:
  struct Setting {
    std::string text;
    int line = 0;
  };

  double value(const std::string& key, double otherwise) const {
    const auto found = settings_.find(key);
    if (found == settings_.end()) return otherwise;
    const std::optional<double> number = number_of(found->second.text);
    if (!number || !std::isfinite(*number))
      refuse(fmt::format("{} = {} is not a finite number", key, found->second.text), "repair the setting", name_,
             found->second.line);
    return *number;
  }
  template <class Component>
  void bound(const std::string& axis, Component component) {
    const double min = value("spline.bound." + axis + ".min", 0), max = value("spline.bound." + axis + ".max", 0);
    if (min < max)
      note_dropped(keep_points(table_, [&](Vec2 p, const Vec2*) { return component(p) >= min && component(p) <= max; }),
                   "bound." + axis);
  }
  double mirror(const std::string& axis) {
    if (value("spline.mirror." + axis, 0) == 0) return 1;
    note(fmt::format("mirror.{} reversed the sign of {}.", axis, axis));
    return -1;
  }
  void note(std::string text) { table_.notes.push_back(std::move(text)); }
  void note_dropped(std::size_t count, const std::string& why) {
    if (count > 0) note(fmt::format("{} points were dropped by {}.", count, why));
  }

  std::string name_;
  NumberTable table_;
  std::map<std::string, Setting> settings_;
};

}  // namespace

NumberTable parse_simpack(ProfileKind kind, std::string_view text, const std::string& name) {
  return Simpack(kind, text, name).points();
}

NumberTable parse_miniprof(std::string_view text, const std::string& name) {
  NumberTable table;
  bool header = true, keys = false;
  std::size_t switched_off = 0;
  std::optional<double> announced;
  each_line(text, [&](std::string_view line, int number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (line.empty()) {
      header = header && !keys;  // a blank line ends a header of keys
      return;
    }
    if (line.front() == '"' || line.front() == '#') {
      switched_off += line.front() == '"' && point_of(split_words(line.substr(1))) ? 1 : 0;
      return;
    }
    if (const std::size_t equals = line.find('='); header && equals != std::string_view::npos) {
      keys = true;
      const std::string key = lower(trimmed(line.substr(0, equals))), value = lower(trimmed(line.substr(equals + 1)));
      if (key == "xypoints") announced = number_of(value);
      if (key == "columndef" && !value.starts_with("x,y"))
        refuse(fmt::format("'{}': the columns do not begin with X,Y", line),
               "export the profile with the columns X and Y first", name, number);
      return;
    }
    const auto words = split_words(line);
    const bool all_numbers = std::all_of(words.begin(), words.end(), [](auto word) { return number_of(word); });
    if (header && (keys || !all_numbers || !point_of(words))) return;
    header = false;
    add_point(table, line, number, name);
  });
  table.notes.push_back(fmt::format("MiniProf profile of {} points.", table.rows.size()));
  if (switched_off > 0) table.notes.push_back(fmt::format("{} points in quotes are switched off.", switched_off));
  const auto there = static_cast<double>(table.rows.size());
  if (announced && there + static_cast<double>(switched_off) < *announced)
    refuse(fmt::format("XYPoints gives {}, but there are {} points: the file is cut off", *announced, there),
           "put a whole copy of the file back, or correct XYPoints if points were taken out by hand", name, 0);
  if (announced && *announced != there) table.notes.push_back(fmt::format("XYPoints gives {}.", *announced));
  table.columns = 2;  // the others are angle, curvature and the like
  return table;
}

}  // namespace railstrata
