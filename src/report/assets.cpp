#include "report/assets.hpp"

// The assembler takes the files in as they are: no array of a million numbers to compile. RAILSTRATA_REPORT_FOLDER
// comes from CMake.
#define RAILSTRATA_ASSET(name, file)                                              \
  asm(".pushsection .rodata\n"                                                    \
      ".global railstrata_" #name "_begin\n.hidden railstrata_" #name             \
      "_begin\n"                                                                  \
      ".global railstrata_" #name "_end\n.hidden railstrata_" #name               \
      "_end\n"                                                                    \
      "railstrata_" #name "_begin:\n.incbin \"" RAILSTRATA_REPORT_FOLDER "/" file \
      "\"\n"                                                                      \
      "railstrata_" #name "_end:\n.byte 0\n.popsection\n");                       \
  extern "C" __attribute__((visibility("hidden"))) const char railstrata_##name##_begin[], railstrata_##name##_end[];

RAILSTRATA_ASSET(script, "dist/report.js")
RAILSTRATA_ASSET(style, "dist/report.css")
RAILSTRATA_ASSET(licences, "dist/LICENSES.txt")
RAILSTRATA_ASSET(view, "view.py")

namespace railstrata {

std::string_view report_script() { return {railstrata_script_begin, railstrata_script_end}; }
std::string_view report_style() { return {railstrata_style_begin, railstrata_style_end}; }
std::string_view report_licences() { return {railstrata_licences_begin, railstrata_licences_end}; }
std::string_view view_script() { return {railstrata_view_begin, railstrata_view_end}; }

}  // namespace railstrata
