#pragma once
// The page of a study.
#include <filesystem>
#include <vector>

#include "study/published.hpp"
#include "study/study_file.hpp"
#include "study/study_results.hpp"

namespace railstrata {

/// Writes report.html into the study's folder: its figures, tables and checks over all cases that are done. Failing, it
/// warns: the results are there without it.
void add_study_page(const std::filesystem::path& out, const LoadedStudy& study, const Published& published,
                    const std::vector<StudyRow>& rows);

}  // namespace railstrata
