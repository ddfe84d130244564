# What web/dist holds stands inside the program, and the script for ParaView: scripts and styles of the pages, built by
# `npm ci && npm run build` in web/ after a change there; the explorer's engine, built by `./railstrata wasm` at a release.
set(web ${CMAKE_SOURCE_DIR}/web/dist)
set(view ${CMAKE_SOURCE_DIR}/src/results/report/view.py)
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/results/report/assets.cpp PROPERTIES
  COMPILE_DEFINITIONS "RAILSTRATA_WEB_FOLDER=\"${web}\";RAILSTRATA_VIEW_FILE=\"${view}\""
  OBJECT_DEPENDS "${web}/report.js;${web}/report.css;${view}")
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/doors/explore/assets.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_WEB_FOLDER="${web}"
  OBJECT_DEPENDS "${web}/explore.js;${web}/explore.css;${web}/worker.js;${web}/engine.wasm.gz;${web}/engine.js;\
${web}/engine_version.txt;${web}/explore_licences.txt")
