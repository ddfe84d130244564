# The handles of the Python module: objects of their own, once for each instruction set.
execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sysconfig; print(sysconfig.get_config_var('EXT_SUFFIX')[1:])"
  OUTPUT_VARIABLE python_suffix OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(GLOB python_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/core/*.cpp)

# railstrata_python_objects(SUFFIX): target python_objects<SUFFIX>.
function(railstrata_python_objects suffix)
  set(objects python_objects${suffix})
  add_library(${objects} OBJECT ${python_sources})
  target_include_directories(${objects} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${objects} PRIVATE room_study${suffix} pybind11::module)
  set_target_properties(${objects} PROPERTIES CXX_VISIBILITY_PRESET hidden POSITION_INDEPENDENT_CODE ON)
  # pybind11's templates convert signs and shadow names.
  target_compile_options(${objects} PRIVATE -Wno-shadow -Wno-conversion)
endfunction()

# railstrata_python_library(LIBRARY SUFFIX FOLDER): librailstrata-python.so beside a variant's librailstrata.so. What it
# asks of the interpreter is found at import.
function(railstrata_python_library library suffix folder)
  set(python railstrata_python${suffix})
  set(map ${CMAKE_SOURCE_DIR}/cmake/python.map)
  add_library(${python} SHARED $<TARGET_OBJECTS:python_objects${suffix}> $<TARGET_OBJECTS:room_study${suffix}>)
  target_link_libraries(${python} PRIVATE ${library} ${ROOM_LIBS_core} ${ROOM_LIBS_case} ${ROOM_LIBS_post})
  target_link_options(${python} PRIVATE -Wl,--version-script=${map})
  set_target_properties(${python} PROPERTIES OUTPUT_NAME railstrata-python LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
    SOVERSION ${so_version} LINK_DEPENDS ${map} LIBRARY_OUTPUT_DIRECTORY ${folder})
endfunction()
