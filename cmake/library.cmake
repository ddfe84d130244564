# The shared library, the installed program and `cmake --install`.
#
#   librailstrata.so            every room but those of the program. Exported are the functions that the public headers
#                               declare, in C++ and in C.
#   librailstrata-commands.so   the rooms `study` and `app`: the command line of the program, and nothing for others.
#   railstrata                  main() alone.
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
set(ROOMS_OF_THE_PROGRAM study app)
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

  # The version script: a public version with what the public headers declare, a private one with what the program's
  # rooms call besides, all else local.
  set(map ${CMAKE_BINARY_DIR}/generated/librailstrata${suffix}.map)
  add_custom_command(OUTPUT ${map} DEPENDS ${interface_tool} ${lower_archives} ${upper_archives} ${headers_stamp}
    VERBATIM
    COMMAND Python3::Interpreter ${interface_tool} exports --headers ${public_include}/railstrata --nm ${CMAKE_NM}
      --version ${PROJECT_VERSION} --public-version ${so_version} --out ${map} --library ${lower_archives}
      --users ${upper_archives}
    COMMAND_EXPAND_LISTS COMMENT "Listing the symbols of librailstrata${suffix}.so")
  add_custom_target(railstrata_map${suffix} DEPENDS ${map})

  set(library railstrata_library${suffix})
  add_library(${library} SHARED ${lower_objects})
  add_dependencies(${library} railstrata_map${suffix})
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

  foreach(target ${library} ${commands})
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
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

# ---------------------------------------------------------------------------------------------------- cmake --install
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/RailStrata)
set(data_folder ${CMAKE_INSTALL_DATADIR}/railstrata)
install(TARGETS railstrata_program RUNTIME)
install(TARGETS railstrata_library${installed_suffix} EXPORT RailStrataTargets
  LIBRARY INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS railstrata_commands${installed_suffix} LIBRARY NAMELINK_SKIP)
install(TARGETS contact_addon LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/railstrata/contact)
install(FILES ${CMAKE_SOURCE_DIR}/src/${ROOM_OF_CONTACT}/railstrata_cntc.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/railstrata)
foreach(level IN LISTS levels)
  set_target_properties(railstrata_commands_${level} PROPERTIES INSTALL_RPATH "$ORIGIN/../..")
  install(TARGETS railstrata_library_${level} railstrata_commands_${level}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/${hwcaps}/x86-64-${level} NAMELINK_SKIP)
endforeach()
install(DIRECTORY ${public_include}/railstrata DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")

target_compile_features(railstrata_library${installed_suffix} INTERFACE cxx_std_20)
install(EXPORT RailStrataTargets NAMESPACE RailStrata:: DESTINATION ${package_folder})
set(package_build ${CMAKE_BINARY_DIR}/package)
file(WRITE ${package_build}/RailStrataConfig.cmake
  "# find_package(RailStrata): the target RailStrata::railstrata\n"
  "include(\"\${CMAKE_CURRENT_LIST_DIR}/RailStrataTargets.cmake\")\n")
write_basic_package_version_file(${package_build}/RailStrataConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${package_build}/RailStrataConfig.cmake ${package_build}/RailStrataConfigVersion.cmake
  DESTINATION ${package_folder})

# Both paths are relative to the file itself, so that the folder can be moved.
file(RELATIVE_PATH root_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" root_from_pc "${root_from_pc}")
configure_file(${CMAKE_SOURCE_DIR}/cmake/railstrata.pc.in ${package_build}/railstrata.pc @ONLY)
install(FILES ${package_build}/railstrata.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Shipped cases without the recorded results of a study, profiles and published numbers, the script for ParaView, texts.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/cases DESTINATION ${data_folder} PATTERN "recorded" EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/data DESTINATION ${data_folder})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/matlab DESTINATION ${data_folder})
install(FILES ${CMAKE_SOURCE_DIR}/report/view.py ${CMAKE_SOURCE_DIR}/report/dist/report.js
  ${CMAKE_SOURCE_DIR}/report/dist/report.css ${CMAKE_SOURCE_DIR}/report/dist/LICENSES.txt
  DESTINATION ${data_folder}/report)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md"
  PATTERN "*.bib" PATTERN "*.png" PATTERN "reliability" EXCLUDE)
foreach(text README.md LICENSE CHANGELOG.md CITATION.cff)
  install(FILES ${CMAKE_SOURCE_DIR}/${text} DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
endforeach()
file(GLOB manual CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/*.1)
if(manual)
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()

if(RAILSTRATA_NATIVE AND NOT RAILSTRATA_VARIANTS)
  install(CODE "message(WARNING \"This build runs on processors like this one only. For others build with \"
    \"-DRAILSTRATA_VARIANTS=ON (cmake --preset install, or ./railstrata install PREFIX).\")")
endif()
