# What the program says of itself. The git hash is asked for at every build; the file changes, and its one object is
# compiled, only when the answer does.
find_package(Git QUIET)

# railstrata_build_info(SUFFIX): the answer for one variant, with the options of its railstrata_flags.
function(railstrata_build_info suffix)
  get_target_property(options railstrata_flags${suffix} INTERFACE_COMPILE_OPTIONS)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  string(JOIN " " flags ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${options})
  set(output ${CMAKE_BINARY_DIR}/generated/build_info${suffix}.cpp)
  add_custom_target(build_info${suffix} BYPRODUCTS ${output} COMMENT "" VERBATIM
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DSOURCE=${CMAKE_SOURCE_DIR} "-DGIT=${GIT_EXECUTABLE}"
      "-DVERSION=${PROJECT_VERSION}" "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
      "-DFLAGS=${flags}" -DPARTS=${RAILSTRATA_PARTS_FILE} "-DBUILD_TYPE=${CMAKE_BUILD_TYPE}" -P ${CMAKE_SOURCE_DIR}/cmake/write_build_info.cmake)
  add_library(railstrata_build_info${suffix} STATIC ${output})
  add_dependencies(railstrata_build_info${suffix} build_info${suffix})
  target_link_libraries(railstrata_build_info${suffix} PRIVATE railstrata_flags${suffix})
  if("io" IN_LIST ROOMS${suffix})
    target_link_libraries(room_io${suffix} PUBLIC railstrata_build_info${suffix})
  endif()
endfunction()
