#pragma once
// Files of web/dist that the program carries with it: the page's script and style as they are now, the engine of the
// last release.
#include <string_view>

namespace railstrata {

std::string_view explorer_script();          ///< explore.js: the page
std::string_view explorer_style();           ///< explore.css
std::string_view explorer_worker();          ///< worker.js: the engine's thread
std::string_view explorer_engine();          ///< engine.wasm.gz
std::string_view explorer_engine_script();   ///< engine.js: the compiler's script, which starts the engine
std::string_view explorer_engine_version();  ///< engine_version.txt: version_text() of its sources
std::string_view explorer_licences();        ///< explore_licences.txt: of the software in the engine

}  // namespace railstrata
