# The page's script and style, built by hand with `npm ci && npm run build` in report/ and committed, stand inside the
# program.
set(report ${CMAKE_SOURCE_DIR}/report)
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/report/assets.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_REPORT_FOLDER="${report}"
  OBJECT_DEPENDS "${report}/dist/report.js;${report}/dist/report.css;${report}/dist/LICENSES.txt;${report}/view.py")
