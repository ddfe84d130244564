// Of a DLL: it stays until the program ends. Its threads wait for the next parallel loop, and a program that unloads
// the library would take their code away from under them.
#include <windows.h>

namespace {

__attribute__((constructor)) void stay_loaded() {
  HMODULE own = nullptr;
  ::GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS,
                       reinterpret_cast<LPCWSTR>(&stay_loaded), &own);
}

}  // namespace
