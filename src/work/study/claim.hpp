#pragma once
// Which of several processes, on any machines that share a folder, computes a case: no server, no locks of the file
// system. A claim is a file that only one can create (O_EXCL). Its owner renews it; one that is not renewed for its
// lease, by the clock of the file server, is dead and may be taken by another, by a rename that only one wins.
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace railstrata {

inline constexpr double kDefaultLease = 300;  // s

class Claim {
 public:
  /// `file`, if no living process has it; a dead claim is taken over. lease: seconds without renewal after which
  /// others may hold this process for dead (they read it in the claim). The machines' own clocks play no part. Throws
  /// EnvironmentError if the file cannot be written.
  static std::optional<Claim> take(const std::filesystem::path& file, double lease);
  /// Gives it back, if it is still ours.
  ~Claim();
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&&) = delete;

  /// No other process has taken it over because it considered this one dead.
  bool is_ours() const;
  /// To be called at least ten times a lease; touches the file every tenth. False once it is no longer ours.
  bool renew();

 private:
  Claim(std::filesystem::path file, std::string text, double lease);
  std::filesystem::path file_;
  std::string text_;  ///< text that only our own claim has
  double lease_;
  std::chrono::steady_clock::time_point renewed_ = std::chrono::steady_clock::now();
  bool ours_ = true;
};

/// The clock of the file system that holds the folder, in s: a file of our own is touched there. None if that cannot be
/// done. `beside`: the name that the file's begins with.
std::optional<double> file_server_time(const std::filesystem::path& beside);
/// When the file was written last, by the same clock; none if there is no such file.
std::optional<double> written_at(const std::filesystem::path& file);

/// Who has claimed the file, for messages: "node7, process 4711, job 12_3"; empty if no one has.
std::string claimed_by(const std::filesystem::path& file);

}  // namespace railstrata
