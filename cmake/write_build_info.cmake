# cmake -P script: OUTPUT SOURCE GIT VERSION COMPILER FLAGS BUILD_TYPE -> definition of build_info() in
# io/provenance.hpp
set(commit "")
set(dirty false)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=12 HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT} -C ${SOURCE} status --porcelain -- src cmake report CMakeLists.txt
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
  endif()
endif()
string(REPLACE "\"" "\\\"" FLAGS "${FLAGS}")
set(text "#include \"io/provenance.hpp\"

const railstrata::BuildInfo& railstrata::build_info() {
  static const BuildInfo info{\"${VERSION}\", \"${commit}\", ${dirty}, \"${COMPILER}\",
                              \"${FLAGS}\", \"${BUILD_TYPE}\"};
  return info;
}
")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "${text}" @ONLY)
