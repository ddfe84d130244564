#include "app/program.hpp"

#include <windows.h>

#include <cstdlib>

namespace railstrata {
namespace {

UINT code_page = 0;  // of the console before

}  // namespace

void settle_in() {
  code_page = ::GetConsoleOutputCP();
  ::SetConsoleOutputCP(CP_UTF8);
  std::atexit([] { ::SetConsoleOutputCP(code_page); });
  const HANDLE errors = ::GetStdHandle(STD_ERROR_HANDLE);
  if (DWORD mode = 0; ::GetConsoleMode(errors, &mode) != 0)  // the progress clears its line by an escape sequence
    ::SetConsoleMode(errors, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

}  // namespace railstrata
