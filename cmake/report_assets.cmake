# The page's script and style, built by hand with `npm ci && npm run build` in report/ and committed, stand inside the program.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/report/assets.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_REPORT_FOLDER="${CMAKE_SOURCE_DIR}/report"
  OBJECT_DEPENDS "${CMAKE_SOURCE_DIR}/report/dist/report.js;${CMAKE_SOURCE_DIR}/report/dist/report.css;${CMAKE_SOURCE_DIR}/report/dist/LICENSES.txt;${CMAKE_SOURCE_DIR}/report/view.py")
