#pragma once
// A case file (TOML) becomes a CaseSpec, or a CaseError that holds every error of the file at once.
#include <filesystem>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "rules/idle_setting.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

struct LoadedCase {
  CaseSpec spec;
  std::filesystem::path file;                 ///< as given
  std::string source_text;                    ///< the file as it was read; the case of an input of CONTACT
  std::vector<std::string> overrides;         ///< "key=value", as given
  std::string resolved_toml;                  ///< every option with its value: reads back to the same spec, bit for bit
  std::vector<std::string> notes;             ///< what is allowed but reported, whatever the use
  std::vector<IdleSetting> idle;              ///< settings without effect in some uses alone
  std::vector<std::filesystem::path> inputs;  ///< every file that went in: the case and the profile files
  /// Folder against which relative profile names are understood.
  std::filesystem::path folder() const { return file.parent_path(); }
};

/// Reads, applies the overrides ("mesh.element_size=2 mm", "layer.0.thickness=0.5 mm"; quotes may be left out), checks
/// units, ranges and what options ask of each other. Profile files are looked for, not read. An input of CONTACT
/// (tables/contact_input.hpp) is read as the case it describes. Throws CaseError.
LoadedCase load_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from a text; `file` names it in messages and gives the folder of relative profile names.
LoadedCase parse_case(const std::string& text, const std::filesystem::path& file,
                      const std::vector<std::string>& overrides = {});

/// The same case with further overrides after its own.
LoadedCase with_overrides(const LoadedCase& loaded, const std::vector<std::string>& further);

/// The same faults, those that name a key of the case alone (in `where`) at its place in the file, others at the file.
CaseError in_case_file(const LoadedCase& loaded, const CaseError& error);

/// The work's result; CaseErrors of it get their places in the case.
template <class Work>
auto with_places(const LoadedCase& loaded, Work&& work) {
  try {
    return work();
  } catch (const CaseError& e) {
    throw in_case_file(loaded, e);
  }
}

/// What a use does not support of the case (rules/support.hpp), each at its place in the file.
std::vector<Diagnostic> refused_by(const Use& use, const LoadedCase& loaded);
/// Throws CaseError with all of them.
void require_support(const Use& use, const LoadedCase& loaded);

/// Notes on the case and on its settings without effect in a use.
std::vector<std::string> notes_for(const Use& use, const LoadedCase& loaded);
/// Those on settings that run.rolling = false takes the effect of.
std::vector<std::string> notes_at_rest(const LoadedCase& loaded);

/// The spec as a case file with every option written out.
std::string resolved_case(const CaseSpec& spec);

}  // namespace railstrata
