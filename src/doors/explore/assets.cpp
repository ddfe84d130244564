#include "explore/assets.hpp"

#include "core/embedded_file.hpp"

// RAILSTRATA_WEB_FOLDER comes from CMake.
#define RAILSTRATA_ASSET(name, file) RAILSTRATA_EMBED(railstrata_explorer_##name, RAILSTRATA_WEB_FOLDER "/" file)

RAILSTRATA_ASSET(script, "explore.js")
RAILSTRATA_ASSET(style, "explore.css")
RAILSTRATA_ASSET(worker, "worker.js")
RAILSTRATA_ASSET(engine, "engine.wasm.gz")
RAILSTRATA_ASSET(licences, "explore_licences.txt")

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
