#include "explore/assets.hpp"

#include "core/embedded_file.hpp"

// RAILSTRATA_WEB_FOLDER comes from CMake.
#define RAILSTRATA_ASSET(name, file)                                               \
  RAILSTRATA_EMBED(railstrata_explorer_##name, RAILSTRATA_WEB_FOLDER "/" file)     \
  std::string_view railstrata::explorer_##name() {                                 \
    return {railstrata_explorer_##name##_begin, railstrata_explorer_##name##_end}; \
  }

RAILSTRATA_ASSET(script, "explore.js")
RAILSTRATA_ASSET(style, "explore.css")
RAILSTRATA_ASSET(worker, "worker.js")
RAILSTRATA_ASSET(engine, "engine.wasm.gz")
RAILSTRATA_ASSET(engine_script, "engine.js")
RAILSTRATA_ASSET(engine_version, "engine_version.txt")
RAILSTRATA_ASSET(licences, "explore_licences.txt")
