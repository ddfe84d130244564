# What the program says of itself. The git hash is asked for at every build; the file changes, and its one object is compiled, only when the answer does.
get_target_property(options railstrata_flags INTERFACE_COMPILE_OPTIONS)
string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
string(JOIN " " flags ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${options})
find_package(Git QUIET)
set(BUILD_INFO_CPP ${CMAKE_BINARY_DIR}/generated/build_info.cpp)
add_custom_target(build_info BYPRODUCTS ${BUILD_INFO_CPP} COMMENT "" VERBATIM
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${BUILD_INFO_CPP} -DSOURCE=${CMAKE_SOURCE_DIR} "-DGIT=${GIT_EXECUTABLE}" "-DVERSION=${PROJECT_VERSION}"
    "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" "-DFLAGS=${flags}" "-DBUILD_TYPE=${CMAKE_BUILD_TYPE}"
    -P ${CMAKE_SOURCE_DIR}/cmake/write_build_info.cmake)
add_library(railstrata_build_info STATIC ${BUILD_INFO_CPP})
add_dependencies(railstrata_build_info build_info)
target_link_libraries(railstrata_build_info PRIVATE railstrata_flags)
target_link_libraries(room_io PUBLIC railstrata_build_info)
