// Keeps a DLL loaded until the program ends: its threads wait for the next parallel loop and need its code.
#include <windows.h>

namespace {

__attribute__((constructor)) void stay_loaded() {
  HMODULE own = nullptr;
  ::GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_PIN | GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS,
                       reinterpret_cast<LPCWSTR>(&stay_loaded), &own);
}

}  // namespace
