#pragma once
// The results in a study's folder: a folder for each case, which holds either a complete result or does not exist.
#include <filesystem>
#include <string>
#include <vector>

#include "many/case_row.hpp"
#include "study/claim.hpp"
#include "study/study_plan.hpp"

namespace railstrata {

/// Beside the files of `run` or `bem`: the key of the result, the fault, numbers of the sections.
inline constexpr const char* kStudyFile = "study.json";

/// A result that stands where another case of the same key would put it (the groups have changed their order) is taken
/// from there.
void find_results(const std::filesystem::path& out, std::vector<StudyCase>& cases);

/// The folder holds the result of this very case.
bool is_done(const std::filesystem::path& out, const StudyCase& c);
/// Why the last attempt failed; empty if none did.
std::string last_failure(const std::filesystem::path& out, const StudyCase& c);

/// The working folder of a case while it is computed, this process' own.
std::filesystem::path working_folder(const std::filesystem::path& out, const StudyCase& c);

/// The process that computes the case holds this claim. The functions below that change something of a case are for its
/// owner alone.
std::filesystem::path claim_file(const std::filesystem::path& out, const StudyCase& c);

/// Takes the working folder for the result: writes study.json into it and renames it into place as the last act, so
/// that a result is there whole or not at all. False, and nothing kept, if the claim is no longer ours.
bool keep_result(const std::filesystem::path& out, const StudyCase& c, const std::filesystem::path& working,
                 const Claim& claim);
/// Keeps what a failed case has left, with its log and reason, as <folder>.failed. False as keep_result.
bool keep_failure(const std::filesystem::path& out, const StudyCase& c, const std::filesystem::path& working,
                  const std::string& reason, const Claim& claim);

/// After a crash: of every case that no living process claims, results that were whole and not yet renamed are taken;
/// working folders are removed, of whatever machine, but for those with a checkpoint of a case that is not done yet; so
/// are tables that a process had half written.
void recover(const std::filesystem::path& out, const std::vector<StudyCase>& cases, double lease = kDefaultLease);

/// Makes a working folder that an earlier owner of the claim, on any machine, or a failure has left of this very case,
/// with a checkpoint of this very program, the `working` one; removes the others. False if there is none: then there is
/// no working folder.
bool take_over(const std::filesystem::path& out, const StudyCase& c, const std::filesystem::path& working);

/// The table as it stands, a row for each of the cases; its folders are relative to `out`.
std::vector<CaseRow> study_rows(const std::filesystem::path& out, const std::vector<StudyCase>& cases);

/// study.csv: group, case, engine, the keys varied, the numbers with units in their names, folder, state, fault.
void write_study_table(const std::filesystem::path& file, std::vector<std::string> origin,
                       const std::vector<CaseRow>& rows);

}  // namespace railstrata
