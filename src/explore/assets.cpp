#include "explore/assets.hpp"

// As report/assets.cpp: the assembler takes the files in as they are. RAILSTRATA_EXPLORE_FOLDER comes from CMake.
#define RAILSTRATA_ASSET(name, file)                                                                \
  asm(".pushsection .rodata\n"                                                                      \
      ".global railstrata_explorer_" #name "_begin\n.hidden railstrata_explorer_" #name             \
      "_begin\n"                                                                                    \
      ".global railstrata_explorer_" #name "_end\n.hidden railstrata_explorer_" #name               \
      "_end\n"                                                                                      \
      "railstrata_explorer_" #name "_begin:\n.incbin \"" RAILSTRATA_EXPLORE_FOLDER "/" file         \
      "\"\n"                                                                                        \
      "railstrata_explorer_" #name "_end:\n.byte 0\n.popsection\n");                                \
  extern "C" __attribute__((visibility("hidden"))) const char railstrata_explorer_##name##_begin[], \
      railstrata_explorer_##name##_end[];

RAILSTRATA_ASSET(script, "explore.js")
RAILSTRATA_ASSET(style, "explore.css")
RAILSTRATA_ASSET(worker, "worker.js")
RAILSTRATA_ASSET(engine, "engine.wasm.gz")
RAILSTRATA_ASSET(licences, "LICENSES.txt")

namespace railstrata {

namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

std::string_view explorer_script() { return between(railstrata_explorer_script_begin, railstrata_explorer_script_end); }
std::string_view explorer_style() { return between(railstrata_explorer_style_begin, railstrata_explorer_style_end); }
std::string_view explorer_worker() { return between(railstrata_explorer_worker_begin, railstrata_explorer_worker_end); }
std::string_view explorer_engine() { return between(railstrata_explorer_engine_begin, railstrata_explorer_engine_end); }
std::string_view explorer_licences() {
  return between(railstrata_explorer_licences_begin, railstrata_explorer_licences_end);
}

}  // namespace railstrata
