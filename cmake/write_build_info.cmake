# cmake -P script: OUTPUT SOURCE GIT VERSION COMPILER FLAGS PARTS BUILD_TYPE -> definition of build_info() in
# io/provenance.hpp
set(commit "")
set(dirty false)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=12 HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT} -C ${SOURCE} status --porcelain -- src extras cmake CMakeLists.txt
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
  endif()
endif()
string(REPLACE "\"" "\\\"" FLAGS "${FLAGS}")
file(STRINGS ${PARTS} lines)
set(parts "")
foreach(line IN LISTS lines)
  string(REPLACE "\"" "\\\"" line "${line}")
  string(REGEX REPLACE "^([^|]*)[|](.*)$" "{\"\\1\", \"\\2\"}" line "${line}")
  list(APPEND parts "${line}")
endforeach()
string(JOIN ", " parts ${parts})
set(text "#include \"io/provenance.hpp\"

const railstrata::BuildInfo& railstrata::build_info() {
  static const BuildInfo info{\"${VERSION}\", \"${commit}\", ${dirty}, \"${COMPILER}\",
                              \"${FLAGS}\", \"${BUILD_TYPE}\", {${parts}}};
  return info;
}
")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "${text}" @ONLY)
