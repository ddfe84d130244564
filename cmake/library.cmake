# The shared library, the installed program and `cmake --install`.
#
#   librailstrata.so            every room but those of the program. Exported are the functions that the public headers
#                               declare, in C++ and in C.
#   librailstrata-commands.so   the rooms `study`, `explore` and `app`: the command line of the program, and nothing for
#                               others.
#   railstrata                  main() alone.
#   librailstrata-python.so     the rooms `study` and the handles of the Python module, which is an empty file beside the
#                               Python files that asks for this library: so the loader's choice holds for it too.
#   contact_addon_linux64.so    the room `cntc` with all it needs inside, so that this one file can stand in for that of
#                               CONTACT; in a folder of its own, where nobody finds it by accident.
#
# The libraries are linked from the objects of the static rooms; nothing is compiled twice. Because a SIMD pack has
# another width with every instruction set, both libraries are built for each of them, and the loader takes the pair
# from lib/glibc-hwcaps/x86-64-v3 or -v4 if the processor has what it needs [ld.so(8), glibc 2.33 and later].
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(CheckLinkerFlag)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# The headers that a user of the library includes; those that they include are public too. C++ API, unstable until 1.0.
set(PUBLIC_HEADERS core/faults.hpp case/case_file.hpp io/provenance.hpp runs/library.hpp)
set(C_HEADER capi/railstrata.h)
set(ROOMS_OF_THE_PROGRAM study explore app)
set(ROOM_OF_CONTACT cntc)
# The mark by which the loader refuses a processor that is too old, in words instead of an illegal instruction.
check_linker_flag(CXX -Wl,-z,x86-64-v2 has_level_mark)

# Before 1.0 every minor version may break the binary interface, hence it is part of the name the loader asks for.
set(so_version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if(PROJECT_VERSION_MAJOR GREATER 0)
  set(so_version ${PROJECT_VERSION_MAJOR})
endif()
set(interface_tool ${CMAKE_SOURCE_DIR}/tools/library_interface.py)
set(public_include ${CMAKE_BINARY_DIR}/public/include)

# The public headers as they are installed: include/railstrata/<room>/<name>.hpp, and railstrata.hpp with all of them.
set(headers_stamp ${CMAKE_BINARY_DIR}/public/headers.stamp)
add_custom_command(OUTPUT ${headers_stamp} DEPFILE ${headers_stamp}.d DEPENDS ${interface_tool} VERBATIM
  COMMAND Python3::Interpreter ${interface_tool} headers --src ${CMAKE_SOURCE_DIR}/src
    --out ${public_include}/railstrata --version ${PROJECT_VERSION} --stamp ${headers_stamp} --c ${C_HEADER}
    ${PUBLIC_HEADERS}
  COMMENT "Collecting the library's public headers")
add_custom_target(public_headers ALL DEPENDS ${headers_stamp})

# railstrata_collect(OUT SUFFIX room...): OUT_objects, OUT_archives and the third parties' OUT_libraries of rooms.
function(railstrata_collect out suffix)
  foreach(room IN LISTS ARGN)
    list(APPEND objects $<TARGET_OBJECTS:room_${room}${suffix}>)
    list(APPEND archives $<TARGET_FILE:room_${room}${suffix}>)
    list(APPEND libraries ${ROOM_LIBS_${room}})
  endforeach()
  list(REMOVE_DUPLICATES libraries)
  foreach(part objects archives libraries)
    set(${out}_${part} ${${part}} PARENT_SCOPE)
  endforeach()
endfunction()

# railstrata_library(VARIANT FOLDER LEVEL): both libraries of a variant, written to FOLDER of the build. LEVEL, if
# given, is the instruction set that the loader asks the processor for before it takes them.
function(railstrata_library variant folder level)
  set(suffix "")
  if(variant)
    set(suffix "_${variant}")
  endif()
  set(rooms ${ROOMS${suffix}})
  list(REMOVE_ITEM rooms ${ROOMS_OF_THE_PROGRAM} ${ROOM_OF_CONTACT})
  railstrata_collect(lower "${suffix}" ${rooms})
  railstrata_collect(upper "${suffix}" ${ROOMS_OF_THE_PROGRAM})
  list(APPEND lower_objects $<TARGET_OBJECTS:railstrata_build_info${suffix}>)
  list(APPEND lower_archives $<TARGET_FILE:railstrata_build_info${suffix}>)
  if(RAILSTRATA_WITH_CUDA)  # not among the objects of its room: another compiler has made it
    list(APPEND lower_objects ${RAILSTRATA_CARD_OBJECT})
    list(APPEND lower_libraries ${RAILSTRATA_CUDART} Threads::Threads rt ${CMAKE_DL_LIBS})
  endif()

  set(user_objects "")
  if(RAILSTRATA_PYTHON)
    set(user_objects $<TARGET_OBJECTS:python_objects${suffix}>)
  endif()
  # The version script: a public version with what the public headers declare, a private one with what the program's
  # rooms and the Python module call besides, all else local.
  set(map ${CMAKE_BINARY_DIR}/generated/librailstrata${suffix}.map)
  add_custom_command(OUTPUT ${map} DEPENDS ${interface_tool} ${lower_archives} ${upper_archives} ${headers_stamp}
    ${user_objects} VERBATIM
    COMMAND Python3::Interpreter ${interface_tool} exports --headers ${public_include}/railstrata --nm ${CMAKE_NM}
      --version ${PROJECT_VERSION} --public-version ${so_version} --out ${map} --library ${lower_archives}
      --users ${upper_archives} ${user_objects}
    COMMAND_EXPAND_LISTS COMMENT "Listing the symbols of librailstrata${suffix}.so")
  add_custom_target(railstrata_map${suffix} DEPENDS ${map})

  set(library railstrata_library${suffix})
  add_library(${library} SHARED ${lower_objects})
  add_dependencies(${library} railstrata_map${suffix})
  if(RAILSTRATA_WITH_CUDA)
    add_dependencies(${library} card_object)
  endif()
  target_link_libraries(${library} PRIVATE ${lower_libraries})
  target_link_options(${library} PRIVATE -Wl,--version-script=${map})
  set_target_properties(${library} PROPERTIES OUTPUT_NAME railstrata EXPORT_NAME railstrata LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${so_version} LINK_DEPENDS ${map} LIBRARY_OUTPUT_DIRECTORY ${folder})

  set(commands railstrata_commands${suffix})
  add_library(${commands} SHARED ${upper_objects})
  target_link_libraries(${commands} PRIVATE ${library} ${upper_libraries} ${lower_libraries})
  target_link_options(${commands} PRIVATE -Wl,--version-script=${CMAKE_SOURCE_DIR}/cmake/commands.map)
  set_target_properties(${commands} PROPERTIES OUTPUT_NAME railstrata-commands LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${so_version} LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/commands.map
    LIBRARY_OUTPUT_DIRECTORY ${folder})

  target_link_options(${library} PRIVATE -Wl,--no-undefined)
  target_link_options(${commands} PRIVATE -Wl,--no-undefined)
  set(targets ${library} ${commands})
  if(RAILSTRATA_PYTHON)
    railstrata_python_library(${library} "${suffix}" ${folder})
    list(APPEND targets railstrata_python${suffix})
  endif()
  foreach(target IN LISTS targets)
    if(level AND has_level_mark)
      target_link_options(${target} PRIVATE -Wl,-z,${level})
    endif()
    if(RAILSTRATA_SANITIZE)
      target_link_options(${target} PRIVATE -fsanitize=${RAILSTRATA_SANITIZE})
    endif()
  endforeach()
endfunction()

set(libraries_folder ${CMAKE_BINARY_DIR}/lib)
set(hwcaps glibc-hwcaps)
set(installed_suffix "")
set(levels "")
if(RAILSTRATA_VARIANTS)
  # The oldest processor served is an x86-64-v2 (SSE4.2, from 2009 on); the loader says so on an older one.
  foreach(variant v2 v3 v4)
    set(wide_vectors OFF)
    if(variant STREQUAL "v4")
      set(wide_vectors ON)
    endif()
    railstrata_flags(railstrata_flags_${variant} -march=x86-64-${variant})
    railstrata_rooms(${variant} ${wide_vectors})
    railstrata_build_info(_${variant})
    if(RAILSTRATA_PYTHON)
      railstrata_python_objects(_${variant})
    endif()
  endforeach()
  railstrata_library(v2 ${libraries_folder} x86-64-v2)
  railstrata_library(v3 ${libraries_folder}/${hwcaps}/x86-64-v3 x86-64-v3)
  railstrata_library(v4 ${libraries_folder}/${hwcaps}/x86-64-v4 x86-64-v4)
  set(installed_suffix _v2)
  set(levels v3 v4)
else()
  railstrata_library("" ${libraries_folder} "")
endif()

# One file for all processors that are served: a program that loads it by its path gets that one.
set(contact_map ${CMAKE_SOURCE_DIR}/cmake/contact_addon.map)
add_library(contact_addon SHARED $<TARGET_OBJECTS:room_${ROOM_OF_CONTACT}${installed_suffix}>)
target_link_libraries(contact_addon PRIVATE room_bem${installed_suffix} room_material${installed_suffix})
target_link_options(contact_addon PRIVATE -Wl,--version-script=${contact_map} -Wl,--no-undefined)
set_target_properties(contact_addon PROPERTIES OUTPUT_NAME contact_addon_linux64 PREFIX "" LINKER_LANGUAGE CXX
  LINK_DEPENDS ${contact_map} LIBRARY_OUTPUT_DIRECTORY ${libraries_folder}/railstrata/contact)
if(RAILSTRATA_VARIANTS AND has_level_mark)
  target_link_options(contact_addon PRIVATE -Wl,-z,x86-64-v2)
endif()

if(RAILSTRATA_PYTHON)
  add_library(python_module MODULE ${CMAKE_SOURCE_DIR}/python/module/module.c)
  target_link_libraries(python_module PRIVATE railstrata_python${installed_suffix})
  target_link_options(python_module PRIVATE -Wl,--no-as-needed)
  set_target_properties(python_module PROPERTIES PREFIX "" OUTPUT_NAME _core SUFFIX ".${python_suffix}"
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python-module)
endif()

# The program that is installed; railstrata-bin, which the tests look at, has its rooms inside.
file(RELATIVE_PATH data_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/railstrata)
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/app/shipped_files.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_DATA_FROM_PROGRAM="${data_from_bin}")
file(RELATIVE_PATH lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
add_executable(railstrata_program src/app/main.cpp)
target_include_directories(railstrata_program PRIVATE ${CMAKE_SOURCE_DIR}/src)
target_link_libraries(railstrata_program PRIVATE railstrata_commands${installed_suffix})
set_target_properties(railstrata_program PROPERTIES OUTPUT_NAME railstrata
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin INSTALL_RPATH "$ORIGIN/${lib_from_bin}")
set_target_properties(railstrata_commands${installed_suffix} PROPERTIES INSTALL_RPATH "$ORIGIN")


include(cmake/install.cmake)
include(cmake/packages.cmake)
