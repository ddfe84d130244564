#pragma once
// README.txt of an exported folder: what the files are, how to run them, and what was not carried over.
#include <string>
#include <vector>

#include "export/solid_model.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

enum class ExportTarget { calculix, abaqus, lsdyna, contact };

/// Parts of the case that the files lack, one line each; never empty.
std::vector<std::string> not_carried_over(const CaseSpec& spec, ExportTarget target);

/// The text. `files`: a line each. `friction`: the deck's contact has it. `comparison`: what to expect of numbers there
/// and here.
std::string export_readme(const CaseSpec& spec, ExportTarget target, const std::vector<std::string>& files,
                          bool friction, const std::string& comparison);

/// `comparison` of a deck.
std::string deck_comparison(const SolidModel& model, ExportTarget target);
/// `comparison` of CONTACT's files.
std::string contact_comparison();

}  // namespace railstrata
