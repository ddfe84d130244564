#include <windows.h>
// after windows.h, whose types it takes
#include <shellapi.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "app/program.hpp"

namespace {

// Threads that spin long while they wait cost more than they win where cores are shared. The OpenMP runtime reads such
// settings before main() starts, so they are set earlier still.
__attribute__((constructor(101))) void wait_briefly() {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  ::_putenv("OMP_WAIT_POLICY=passive");
  ::_putenv("GOMP_SPINCOUNT=3000");
}

std::string utf8(const wchar_t* text) {
  const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<std::size_t>(size), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text, -1, out.data(), size, nullptr, nullptr);
  out.pop_back();  // the zero at the end
  return out;
}

}  // namespace

// main()'s own words are in the code page of the machine, which lacks letters of other countries.
int main() {
  int count = 0;
  wchar_t** const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::string> words;
  for (int i = 0; i < count; ++i) words.push_back(utf8(wide[i]));
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  return railstrata::run_program(count, argv.data());
}
