#include "traffic/traffic_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "core/faults.hpp"
#include "jobs/duration_text.hpp"
#include "traffic/uncertain_inputs.hpp"

namespace railstrata {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kLifeUnknown = std::numeric_limits<double>::quiet_NaN();

/// A life, or how far it was followed.
double at_least(const FollowedLife& life) { return std::isinf(life.mgt) ? life.followed : life.mgt; }

/// "12.3 MGT", "> 50 MGT"
std::string life_words(const FollowedLife& life) {
  return range_text({life.mgt, life.mgt, life.mgt}, life.followed) + " MGT";
}

/// √Σ v², the same bits in any order.
double root_of_squares(std::vector<double> values) {
  for (double& v : values) v *= v;
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double v : values) sum += v;
  return std::sqrt(sum);
}

/// Effects that are infinite as those of a life as long as what was followed.
double finite(double effect, const FollowedLife& best, const InputEffect& of) {
  if (std::isfinite(effect)) return effect;
  double longest = best.followed;
  for (std::size_t end = 0; end < of.life.size(); ++end)
    if (of.known[end] && std::isinf(of.life[end].mgt)) longest = std::max(longest, of.life[end].followed);
  return longest > at_least(best) ? std::log(longest / at_least(best)) : 0;
}

/// A life that a list of rows has: of one row, or the first of all.
using ReadLife = std::function<FollowedLife(const std::vector<LifeRow>&)>;

/// Lives with the low or the high values of the damage laws as if they were the best.
std::vector<LifeRow> by_law(std::vector<LifeRow> lives, double LifeRange::*end) {
  for (LifeRow& row : lives) row.mgt.best = row.mgt.*end;
  return lives;
}

std::vector<InputEffect> effects_on(const std::vector<RangeRun>& runs, const std::vector<NamedInput>& inputs,
                                    const ReadLife& read) {
  const std::vector<LifeRow>& best = runs.front().result.lives;
  std::vector<InputEffect> out;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    InputEffect& effect = out.emplace_back();
    effect.input = inputs[i].name;
    effect.key = inputs[i].key;
    for (std::size_t end = 0; end < 2; ++end) {
      const RangeRun& run = runs[1 + 2 * i + end];
      effect.value[end] = run.value;
      effect.life[end] = run.fault.empty() ? read(run.result.lives) : FollowedLife{kLifeUnknown, 0};
    }
  }
  InputEffect& law = out.emplace_back();
  law.input = kDamageLaw;
  law.value = {"its low end", "its high end"};
  law.life = {read(by_law(best, &LifeRange::low)), read(by_law(best, &LifeRange::high))};
  for (InputEffect& effect : out) set_effect(read(best), effect);
  return out;
}

/// A row of the best values with the range of all inputs.
LifeRow with_range(const std::vector<RangeRun>& runs, const std::vector<NamedInput>& inputs, LifeRow row) {
  if (!row.known() || inputs.empty()) return row;
  const ReadLife read = [&](const std::vector<LifeRow>& lives) {
    const LifeRow* found = same_row(lives, row);
    return found ? FollowedLife{found->mgt.best, found->followed} : FollowedLife{kLifeUnknown, 0};
  };
  const ClockResult& best = runs.front().result;
  const double wheels = 1e6 * best.wheels / best.tonnes;  // of a million gross tonnes
  row.mgt = combined(read(best.lives), effects_on(runs, inputs, read));
  const auto of = [&](double mgt) { return mgt == row.mgt.best ? row.wheels.best : wheels * mgt; };
  row.wheels = {of(row.mgt.low), row.wheels.best, of(row.mgt.high)};
  row.rests_on += "; range of all inputs: range.csv";
  return row;
}

/// Gives the progress and the lines of a control the number of the run, while it lives.
class Numbered {
 public:
  explicit Numbered(Control& control) : control_(control), progress_(control.on_progress), info_(control.on_info) {}
  ~Numbered() {
    control_.on_progress = progress_;
    control_.on_info = info_;
  }
  Numbered(const Numbered&) = delete;
  Numbered& operator=(const Numbered&) = delete;

  void begin(std::size_t run, std::size_t of, const std::string& what) {
    if (progress_)
      control_.on_progress = [=, this](const std::string& phase, double fraction, int number) {
        if (!phase.empty())
          progress_(fmt::format("{} runs", of), (static_cast<double>(run) + fraction) / static_cast<double>(of),
                    number);
      };
    if (info_)
      control_.on_info = [=, this](const std::string& text) {
        info_(fmt::format("run {} of {}, {}: {}", run + 1, of, what, text));
      };
  }

 private:
  Control& control_;
  std::function<void(const std::string&, double, int)> progress_;
  std::function<void(const std::string&)> info_;
};

}  // namespace

LifeRange combined(const FollowedLife& best, const std::vector<InputEffect>& effects) {
  std::vector<double> down, up;
  for (const InputEffect& e : effects) {
    down.push_back(e.down);
    up.push_back(e.up);
  }
  const double high = std::isinf(best.mgt) ? kEndless : best.mgt * std::exp(root_of_squares(up));
  const double fall = root_of_squares(down);
  return {fall > 0 ? at_least(best) * std::exp(-fall) : best.mgt, best.mgt, high};
}

void set_effect(const FollowedLife& best, InputEffect& effect) {
  for (std::size_t end = 0; end < effect.life.size(); ++end) {
    const FollowedLife& life = effect.life[end];
    effect.known[end] = std::isfinite(life.mgt) || (std::isinf(life.mgt) && life.followed >= at_least(best));
    if (!effect.known[end] || life.mgt == best.mgt) continue;
    const double e = std::log(life.mgt / at_least(best));
    effect.down = std::min(effect.down, e);
    effect.up = std::max(effect.up, e);
  }
}

void set_shares(const FollowedLife& best, std::vector<InputEffect>& effects) {
  std::vector<double> all;
  for (const InputEffect& e : effects) {
    all.push_back(finite(e.down, best, e));
    all.push_back(finite(e.up, best, e));
  }
  const double whole = root_of_squares(all);
  for (std::size_t i = 0; i < effects.size() && whole > 0; ++i)
    effects[i].share = (all[2 * i] * all[2 * i] + all[2 * i + 1] * all[2 * i + 1]) / (whole * whole);
  std::sort(effects.begin(), effects.end(), [](const InputEffect& a, const InputEffect& b) {
    return a.share != b.share ? a.share > b.share : a.input < b.input;
  });
}

const LifeRow* same_row(const std::vector<LifeRow>& lives, const LifeRow& row) {
  for (const LifeRow& other : lives)
    if (other.zone == row.zone && other.place == row.place && other.mechanism == row.mechanism && other.known())
      return &other;
  return nullptr;
}

TrafficRange range_of(std::vector<RangeRun> runs, const std::vector<NamedInput>& inputs) {
  TrafficRange out;
  const ReadLife read = [](const std::vector<LifeRow>& lives) {
    const LifeRow* row = first_damage(lives);
    return row ? FollowedLife{row->mgt.best, row->followed} : FollowedLife{kLifeUnknown, 0};
  };
  const ClockResult& best = runs.front().result;
  for (const LifeRow& row : best.lives) out.lives.push_back(with_range(runs, inputs, row));
  const FollowedLife first = read(best.lives);
  out.followed = 1e-9 * best.reached;
  if (!std::isnan(first.mgt)) {
    out.effects = effects_on(runs, inputs, read);
    out.first = combined(first, out.effects);
    set_shares(first, out.effects);
  }
  out.runs = std::move(runs);
  return out;
}

TrafficRange run_range(const CaseSpec& spec, const std::filesystem::path& folder, const ClockOptions& options,
                       Control& control) {
  using Watch = std::chrono::steady_clock;
  const std::vector<UncertainInput> inputs = uncertain_inputs(spec);
  std::vector<RangeRun> runs{{"", ""}};
  std::vector<const CaseSpec*> specs{&spec};
  std::vector<NamedInput> names;
  for (const UncertainInput& input : inputs) {
    names.push_back({input.name, input.key});
    for (const InputEnd& end : input.ends) {
      runs.push_back({input.name, end.value});
      specs.push_back(&end.spec);
    }
  }
  ClockOptions how = options;
  how.control = &control;
  Numbered numbered(control);
  const Watch::time_point begin = Watch::now();
  for (std::size_t k = 0; k < runs.size(); ++k) {
    RangeRun& run = runs[k];
    numbered.begin(k, runs.size(), k == 0 ? "best values" : run.input + " " + run.value);
    try {
      run.result = run_clock(*specs[k], folder, how);
      how.keep = {};  // of the best values alone
      how.begun = nullptr;
    } catch (const CaseError& e) {
      if (k == 0) throw;
      run.fault = fault_line(e);
      control.warn("{} {}: cannot be followed, so it is left out of the range: {}", run.input, run.value, run.fault);
      continue;
    } catch (const Interrupted&) {
      if (k == 0) throw;
      for (std::size_t rest = k; rest < runs.size(); ++rest) runs[rest].fault = "stopped before its end";
      control.warn("stopped: the range rests on {} of {} runs", k, runs.size());
      break;
    }
    const LifeRow* first = first_damage(run.result.lives);
    const double spent = std::chrono::duration<double>(Watch::now() - begin).count(),
                 left = static_cast<double>(runs.size() - k - 1);
    control.info("first crack {}{}", first ? life_words({first->mgt.best, first->followed}) : "not known",
                 left > 0 ? fmt::format("; {} left", duration_text(spent / static_cast<double>(k + 1) * left)) : "");
  }
  return range_of(std::move(runs), names);
}

std::string deciding_text(const TrafficRange& range) {
  if (range.effects.empty() || !(range.effects.front().share > 0)) return {};
  const InputEffect& e = range.effects.front();
  return fmt::format("{} decides ({:.0f} % of the range): {} to {} gives {} to {}", e.input, 100 * e.share, e.value[0],
                     e.value[1], e.known[0] ? life_words(e.life[0]) : "not known",
                     e.known[1] ? life_words(e.life[1]) : "not known");
}

}  // namespace railstrata
