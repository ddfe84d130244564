#pragma once
// Where the messages of the interface go, as CONTACT has it: to <outdir>/<experiment>.out, to the screen too if asked.
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>

namespace railstrata::cntc {

/// <outdir>/<experiment>.out, opened with the first line. Safe to share between threads.
class MessageFile {
 public:
  enum class To { file, file_and_screen, nowhere };
  ~MessageFile();
  void set(std::string path, To to);
  void write(std::string_view line);
  void close();

 private:
  std::mutex mutex_;
  std::string path_ = "contact_addon.out";
  To to_ = To::nowhere;
  bool tried_ = false;
  std::FILE* file_ = nullptr;
};

}  // namespace railstrata::cntc
