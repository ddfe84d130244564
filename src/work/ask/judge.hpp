#pragma once
// The only code that fills stresses, warnings, shakedown, layers, fatigue, wear and life of a half-space answer.
#include "ask/answer.hpp"

namespace railstrata {

/// Adds what is wanted and not there yet. `spec`, how.bem: of the answer's contact. Of a transient that
/// was stopped: its wear alone. Throws CaseError where a table of strengths ends too early; Interrupted.
void judge(const CaseSpec& spec, const Wanted& wanted, Answer& answer, const AskOptions& how = {});

/// Shakedown, layers and fatigue of the sections that were judged, by either engine.
void judge_sections(const CaseSpec& spec, const std::vector<SectionShakedown>& sections, Summary& summary);

/// Commit of the program, threads of the caller, memory of the process.
void sign(Summary& summary);

/// Of all patches.
std::vector<StreamlineRow> streamlines_of(const std::vector<PatchDamage>& patches);

}  // namespace railstrata
