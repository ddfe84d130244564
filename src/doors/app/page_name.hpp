#pragma once
// Names of pages that a command line gives.
#include <filesystem>
#include <string>

namespace railstrata {

/// Whether the name ends in .html or .htm.
bool is_page_name(const std::filesystem::path& page);

/// A page by another name opens in no browser, and a result's own files have other names. Throws CaseError: the name
/// of --out does not end in .html or .htm; `preset` is what a name could be.
void require_name_of_page(const std::filesystem::path& page, const std::string& preset);

}  // namespace railstrata
