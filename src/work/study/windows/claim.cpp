// Nobody computes a case of a study here (study_run.cpp), so nobody claims one.
#include "study/claim.hpp"

#include <utility>

#include "study/study_run.hpp"

namespace railstrata {

namespace fs = std::filesystem;

Claim::Claim(fs::path file, std::string text, double lease)
    : file_(std::move(file)), text_(std::move(text)), lease_(lease) {}

Claim::Claim(Claim&&) noexcept = default;

Claim::~Claim() = default;

std::optional<Claim> Claim::take(const fs::path&, double) {
  require_case_processes();
  return {};
}

bool Claim::is_ours() const { return ours_; }

bool Claim::renew() { return ours_; }

std::optional<double> file_server_time(const fs::path&) { return {}; }

std::optional<double> written_at(const fs::path&) { return {}; }

std::string claimed_by(const fs::path&) { return {}; }

}  // namespace railstrata
