# The explorer's page and its engine, built by hand with `./railstrata wasm` and committed in explore/dist, stand inside
# the program.
set(explore_dist ${CMAKE_SOURCE_DIR}/explore/dist)
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/explore/assets.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_EXPLORE_FOLDER="${explore_dist}"
  OBJECT_DEPENDS "${explore_dist}/explore.js;${explore_dist}/explore.css;${explore_dist}/worker.js;${explore_dist}/engine.wasm.gz;${explore_dist}/LICENSES.txt")
