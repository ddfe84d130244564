# The shared library, the installed program and `cmake --install`.
#
#   librailstrata.so            every room and extra but those of the program. Exported are the functions that the
#                               public headers declare, in C++ and in C.
#   librailstrata-commands.so   the rooms `many`, `curving`, `collective`, `creep`, `study`, `validate`, `wear`, `clock`,
#                               `traffic`, `explore` and `app`, the extras `batch`, `usetab` and `export`: the command
#                               line of the program, and nothing for others.
#   railstrata                  main() alone.
#   librailstrata-bridge.so     the rooms `many` and `bridge`: what the Python package calls.
#   librailstrata-hdf5.so       the room `hdf5`, loaded by librailstrata.so when a checkpoint or a table is first asked
#                               for: a program that only solves contacts needs no HDF5.
#   contact_addon_linux64.so    the extra `cntc` with all it needs inside, so that this one file can stand in for that of
#                               CONTACT; in a folder of its own, where nobody finds it by accident.
#
# The libraries are linked from the objects of the static rooms; nothing is compiled twice. fmt, toml++ and zlib are
# inside, so that a program which links librailstrata.so needs the compiler's own libraries alone. For installation
# librailstrata.so is built for three instruction sets: the rooms that compute (ROOMS_OF_VARIANTS) for each of them, the
# others once. The loader takes it from lib/glibc-hwcaps/x86-64-v3 or -v4 if the processor has what it needs
# [ld.so(8), glibc 2.33 and later].
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(CheckLinkerFlag)
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that runs the tools of the build")
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# The headers that a user of the library includes; those that they include are public too. C++ API, unstable until 1.0.
set(PUBLIC_HEADERS core/faults.hpp reader/case_file.hpp io/provenance.hpp ask/library.hpp)
set(C_HEADER capi/railstrata.h)
set(ROOMS_OF_THE_PROGRAM many curving collective creep study validate wear clock traffic explore app batch usetab export)
set(ROOMS_OF_PYTHON many curving collective clock bridge)
set(ROOM_OF_CONTACT cntc)
set(ROOM_OF_HDF5 hdf5)
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
  COMMAND Python3::Interpreter ${interface_tool} headers --src ${WING_FOLDERS}
    --out ${public_include}/railstrata --version ${PROJECT_VERSION} --stamp ${headers_stamp} --c ${C_HEADER}
    ${PUBLIC_HEADERS}
  COMMENT "Collecting the library's public headers")
add_custom_target(public_headers ALL DEPENDS ${headers_stamp})

# What stands inside the libraries in place of libfmt.so, libtomlplusplus.so and libz.so; where it cannot, the linker
# takes those.
find_library(RAILSTRATA_ZLIB_ARCHIVE libz.a)
set(inside_sources ${CMAKE_SOURCE_DIR}/packaging/inside/fmt.cpp ${CMAKE_SOURCE_DIR}/packaging/inside/toml.cpp)

# railstrata_collect(OUT SUFFIX room...): OUT_objects, OUT_archives and the third parties' OUT_libraries of rooms; of
# those that have no such variant, the ones of all processors.
function(railstrata_collect out suffix)
  foreach(room IN LISTS ARGN)
    set(target room_${room}${suffix})
    if(NOT room IN_LIST ROOMS${suffix})
      set(target room_${room}${installed_suffix})
    endif()
    list(APPEND objects $<TARGET_OBJECTS:${target}>)
    list(APPEND archives $<TARGET_FILE:${target}>)
    list(APPEND libraries ${ROOM_LIBS_${room}})
  endforeach()
  list(REMOVE_DUPLICATES libraries)
  if(RAILSTRATA_ZLIB_ARCHIVE)
    list(TRANSFORM libraries REPLACE "^ZLIB::ZLIB$" "${RAILSTRATA_ZLIB_ARCHIVE}")
  endif()
  foreach(part objects archives libraries)
    set(${out}_${part} ${${part}} PARENT_SCOPE)
  endforeach()
endfunction()

# railstrata_shared(TARGET NAME FOLDER MAP): lib<NAME>.so with its version, and what it carries inside.
function(railstrata_shared target name folder map)
  add_library(${target} SHARED ${ARGN} $<TARGET_OBJECTS:inside>)
  target_link_options(${target} PRIVATE -Wl,--as-needed -Wl,--no-undefined -Wl,--version-script=${map})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
    SOVERSION ${so_version} LINK_DEPENDS ${map} LIBRARY_OUTPUT_DIRECTORY ${folder} BUILD_RPATH "$ORIGIN")
  if(level AND has_level_mark)
    target_link_options(${target} PRIVATE -Wl,-z,${level})
  endif()
  if(RAILSTRATA_SANITIZE)
    target_link_options(${target} PRIVATE -fsanitize=${RAILSTRATA_SANITIZE})
  endif()
endfunction()

# Of the libraries, not of their rooms: what they have inside, and the two ends of the plug-in.
function(railstrata_parts_of_libraries)
  add_library(inside OBJECT ${inside_sources})
  target_link_libraries(inside PRIVATE railstrata_flags${installed_suffix} fmt::fmt tomlplusplus::tomlplusplus)
  target_compile_options(inside PRIVATE -w)
  foreach(end plug_in load_plug_in)
    add_library(hdf5_${end} OBJECT ${CMAKE_SOURCE_DIR}/src/results/hdf5/in_library/${end}.cpp)
    target_link_libraries(hdf5_${end} PRIVATE room_table${installed_suffix} room_fem${installed_suffix})
  endforeach()
  target_compile_definitions(hdf5_load_plug_in PRIVATE RAILSTRATA_HDF5_PLUG_IN="librailstrata-hdf5.so.${so_version}")
endfunction()

# railstrata_library(VARIANT FOLDER LEVEL): librailstrata.so of a variant, written to FOLDER of the build. LEVEL, if
# given, is the instruction set that the loader asks the processor for before it takes it.
function(railstrata_library variant folder level)
  set(suffix "")
  if(variant)
    set(suffix "_${variant}")
  endif()
  set(rooms ${ROOMS${installed_suffix}})
  list(REMOVE_ITEM rooms ${ROOMS_OF_THE_PROGRAM} ${ROOMS_OF_PYTHON} ${ROOM_OF_CONTACT} ${ROOM_OF_HDF5})
  railstrata_collect(lower "${suffix}" ${rooms})
  railstrata_collect(users "${installed_suffix}" ${ROOMS_OF_THE_PROGRAM} ${ROOMS_OF_PYTHON} ${ROOM_OF_HDF5})
  list(APPEND lower_objects $<TARGET_OBJECTS:railstrata_build_info${suffix}> $<TARGET_OBJECTS:hdf5_load_plug_in>)
  list(APPEND lower_archives $<TARGET_FILE:railstrata_build_info${suffix}>)
  list(APPEND lower_libraries ${CMAKE_DL_LIBS})
  if(RAILSTRATA_WITH_CUDA)  # not among the objects of its room: another compiler has made it
    list(APPEND lower_objects ${RAILSTRATA_CARD_OBJECT})
    list(APPEND lower_libraries ${RAILSTRATA_CUDART} Threads::Threads rt)
  endif()

  # The version script: a public version with what the public headers declare, a private one with what the program's
  # rooms, the bridge and the plug-in call besides, all else local.
  set(map ${CMAKE_BINARY_DIR}/generated/librailstrata${suffix}.map)
  add_custom_command(OUTPUT ${map} DEPENDS ${interface_tool} ${lower_archives} ${users_archives} ${headers_stamp} VERBATIM
    COMMAND Python3::Interpreter ${interface_tool} exports --headers ${public_include}/railstrata --nm ${CMAKE_NM}
      --version ${PROJECT_VERSION} --public-version ${so_version} --out ${map} --library ${lower_archives}
      --users ${users_archives}
    COMMAND_EXPAND_LISTS COMMENT "Listing the symbols of librailstrata${suffix}.so")
  add_custom_target(railstrata_map${suffix} DEPENDS ${map})

  set(library railstrata_library${suffix})
  railstrata_shared(${library} railstrata ${folder} ${map} ${lower_objects})
  set_target_properties(${library} PROPERTIES EXPORT_NAME railstrata)
  add_dependencies(${library} railstrata_map${suffix})
  if(RAILSTRATA_WITH_CUDA)
    add_dependencies(${library} card_object)
  endif()
  target_link_libraries(${library} PRIVATE ${lower_libraries})
endfunction()

# railstrata_library_users(FOLDER LEVEL): what calls librailstrata.so, the same for every variant of it.
function(railstrata_library_users folder level)
  set(hdf5_rooms ${ROOM_OF_HDF5})
  set(bridge_rooms ${ROOMS_OF_PYTHON})
  set(commands_rooms ${ROOMS_OF_THE_PROGRAM})
  foreach(user hdf5 bridge commands)
    railstrata_collect(own "${installed_suffix}" ${${user}_rooms})
    set(plug_in_end "")
    if(user STREQUAL "hdf5")
      set(plug_in_end $<TARGET_OBJECTS:hdf5_plug_in>)
    endif()
    railstrata_shared(railstrata_${user} railstrata-${user} ${folder} ${CMAKE_SOURCE_DIR}/cmake/${user}.map ${own_objects}
      ${plug_in_end})
    target_link_libraries(railstrata_${user} PRIVATE railstrata_library${installed_suffix} ${own_libraries}
      ${ROOM_LIBS_core} ${ROOM_LIBS_record})
  endforeach()
endfunction()

set(libraries_folder ${CMAKE_BINARY_DIR}/lib)
set(hwcaps glibc-hwcaps)
set(installed_suffix "")
set(levels "")
if(RAILSTRATA_VARIANTS)
  # The oldest processor served is an x86-64-v2 (SSE4.2, from 2009 on); the loader says so on an older one.
  set(installed_suffix _v2)
  set(levels v3 v4)
  foreach(variant v2 ${levels})
    railstrata_flags(railstrata_flags_${variant} -march=x86-64-${variant})
  endforeach()
  railstrata_rooms(v2 OFF)
  railstrata_rooms(v3 OFF ${ROOMS_OF_VARIANTS})
  railstrata_rooms(v4 ON ${ROOMS_OF_VARIANTS})
  railstrata_parts_of_libraries()
  foreach(variant v2 ${levels})
    railstrata_build_info(_${variant})
    set(folder ${libraries_folder})
    if(variant IN_LIST levels)
      string(APPEND folder /${hwcaps}/x86-64-${variant})
    endif()
    railstrata_library(${variant} ${folder} x86-64-${variant})
  endforeach()
  railstrata_library_users(${libraries_folder} x86-64-v2)
else()
  railstrata_parts_of_libraries()
  railstrata_library("" ${libraries_folder} "")
  railstrata_library_users(${libraries_folder} "")
endif()

# For wheels and tarballs (tools/pack.py): stands in for what HDF5 asks for and RailStrata never uses.
add_library(railstrata_no_remote SHARED ${CMAKE_SOURCE_DIR}/packaging/inside/no_remote.c)
target_link_options(railstrata_no_remote PRIVATE
  -Wl,--version-script=${CMAKE_SOURCE_DIR}/packaging/inside/no_remote.map)
set_target_properties(railstrata_no_remote PROPERTIES OUTPUT_NAME railstrata-no-remote
  LIBRARY_OUTPUT_DIRECTORY ${libraries_folder})

# One file for all processors that are served: a program that loads it by its path gets that one.
set(contact_map ${CMAKE_SOURCE_DIR}/cmake/contact_addon.map)
add_library(contact_addon SHARED $<TARGET_OBJECTS:room_${ROOM_OF_CONTACT}${installed_suffix}>
  $<TARGET_OBJECTS:inside>)
target_link_libraries(contact_addon PRIVATE room_bem${installed_suffix} room_material${installed_suffix})
target_link_options(contact_addon PRIVATE -Wl,--as-needed -Wl,--version-script=${contact_map} -Wl,--no-undefined)
set_target_properties(contact_addon PROPERTIES OUTPUT_NAME contact_addon_linux64 PREFIX "" LINKER_LANGUAGE CXX
  LINK_DEPENDS ${contact_map} LIBRARY_OUTPUT_DIRECTORY ${libraries_folder}/railstrata/contact
  INSTALL_RPATH "$ORIGIN/../..")
if(RAILSTRATA_VARIANTS AND has_level_mark)
  target_link_options(contact_addon PRIVATE -Wl,-z,x86-64-v2)
endif()

# The program that is installed; railstrata-bin, which the tests look at, has its rooms inside.
file(RELATIVE_PATH data_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/railstrata)
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/doors/app/shipped_files.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_DATA_FROM_PROGRAM="${data_from_bin}")
file(RELATIVE_PATH lib_from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
add_executable(railstrata_program src/doors/app/main.cpp)
target_include_directories(railstrata_program PRIVATE ${WING_FOLDERS})
target_link_libraries(railstrata_program PRIVATE railstrata_commands)
set_target_properties(railstrata_program PROPERTIES OUTPUT_NAME railstrata
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin INSTALL_RPATH "$ORIGIN/${lib_from_bin}")
add_subdirectory(python)

include(cmake/install.cmake)
include(cmake/packages.cmake)
