#include "clock/wheel_life.hpp"

#include "clock/clock.hpp"
#include "core/faults.hpp"
#include "record/unit.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

LifeOf life_of_wheels(std::filesystem::path folder, const Control* control) {
  return [folder = std::move(folder), control](const CaseSpec& spec, const BemOptions& bem) {
    CaseSpec one = spec;
    LoadSpec wheel;
    wheel.name = "wheel";
    one.loads = {wheel};
    LifeSummary out;
    try {
      const ClockResult followed = run_clock(one, folder, clock_options(spec, bem, control));
      out.text = life_text(followed.lives);
      out.groove = followed.groove;
      for (const std::string& note : followed.notes) out.text += "; note: " + note;
      if (const LifeRow* row = shortest(followed.lives)) {
        out.best = row->mgt.best / unit::kMGT.factor;
        out.low = row->mgt.low / unit::kMGT.factor;
        out.high = row->mgt.high / unit::kMGT.factor;
      }
    } catch (const CaseError& e) {
      out.text = "not known: " + fault_line(e);
    }
    return out;
  };
}

}  // namespace railstrata
