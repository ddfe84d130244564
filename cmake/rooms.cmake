# Rooms: every folder src/<wing>/<name> named in src/LAYERS becomes a library room_<name> that sees the rooms on lower
# floors and nothing else. So does every folder of extras/ named in extras/LAYERS, but for one with a CMakeLists.txt of its own; the
# target `extras` builds them all. A variant is a second build of some of them for another instruction set: its targets end in _<variant>
# (room_fem_v3). The width of a SIMD pack follows from the instruction set: whatever has a pack in it, or is laid out by
# packs, belongs to these rooms, and its names say the width (core/simd.hpp).
set(ROOMS_OF_VARIANTS core material friction halfspace fft damage steady mesh element contact section body bem fem device
  single_track)

include(CheckCXXCompilerFlag)
# Objects are position independent because the shared library is linked from the very objects of the static rooms. With
# this flag calls inside the library are direct and may be inlined, as they are in a program.
check_cxx_compiler_flag(-fno-semantic-interposition has_no_semantic_interposition)
set(CMAKE_POSITION_INDEPENDENT_CODE ${RAILSTRATA_LIBRARY})

# railstrata_flags(TARGET option...): compile and link options that every target of a variant shares. The further
# arguments are the options of its instruction set.
function(railstrata_flags target)
  add_library(${target} INTERFACE)
  target_include_directories(${target} INTERFACE ${WING_FOLDERS})
  # -Wsign-conversion, which -Wconversion brings with clang++, stays off: positions are int and ptrdiff_t, containers
  # ask for size_t, and what must not be negative is tested where it is read.
  target_compile_options(${target} INTERFACE
    -Wall -Wextra -Wconversion -Wno-sign-conversion -Wshadow -fno-math-errno -ffp-contract=fast)
  if(RAILSTRATA_LIBRARY AND has_no_semantic_interposition)
    target_compile_options(${target} INTERFACE -fno-semantic-interposition)
  endif()
  if(RAILSTRATA_WERROR)
    target_compile_options(${target} INTERFACE -Werror)
    # What g++ guesses after optimization changes with the processor, the level and the sanitizers: warnings, no errors.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} INTERFACE -Wno-error=maybe-uninitialized -Wno-error=array-bounds
        -Wno-error=stringop-overflow -Wno-error=restrict)
    endif()
  endif()
  # Eigen serves set-up work only; its AVX-512 paths draw false warnings from g++ 12 and slow compilation down.
  target_compile_definitions(${target} INTERFACE EIGEN_DONT_VECTORIZE)
  target_compile_options(${target} INTERFACE ${ARGN})
  if(RAILSTRATA_SANITIZE)
    # A finding ends the test; the standard library's own asserts see what a sanitizer does not (an index beyond size()
    # and within the capacity).
    target_compile_options(${target} INTERFACE
      -fsanitize=${RAILSTRATA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS)
    target_link_options(${target} INTERFACE -fsanitize=${RAILSTRATA_SANITIZE})
  endif()
  if(RAILSTRATA_COVERAGE)
    target_compile_options(${target} INTERFACE --coverage -fprofile-update=atomic)
    target_link_options(${target} INTERFACE --coverage)
  endif()
endfunction()

# A light build. Three quarters of what a source file reads are headers of others, and most of what it compiles are their
# templates, again in every file: the sources of a room are compiled together (RAILSTRATA_UNITY), so many at a time; a
# source with compile options of its own stays alone. Rooms that compute nothing are compiled with -O1.
set(SOURCES_AT_ONCE 24)
set(ROOMS_THAT_COMPUTE_NOTHING record text spec options tables rules reader hdf5 io passes report jobs ask runs many
  laboratory curving collective creep study validate wear clock traffic explore app bridge batch usetab export)

# railstrata_light(TARGET NAME): these rules for the sources of a room or of its tests.
function(railstrata_light target name)
  if(RAILSTRATA_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${SOURCES_AT_ONCE})
    # g++ takes the unnamed namespace of a source for that of a header where another file includes it
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(name IN_LIST ROOMS_THAT_COMPUTE_NOTHING AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# railstrata_light_test(TARGET): the same for a program of tests. Their sources stay apart, since each says its names
# anew; they read the headers that most of them share compiled, once for all programs.
function(railstrata_light_test target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess) # else ccache refuses what reads a compiled header
  endif()
  get_property(first GLOBAL PROPERTY RAILSTRATA_FIRST_TEST)
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY RAILSTRATA_FIRST_TEST ${target})
    target_precompile_headers(${target} PRIVATE <gtest/gtest.h> <fmt/format.h> <algorithm> <array> <cmath> <filesystem>
      <fstream> <functional> <limits> <map> <numbers> <optional> <random> <sstream> <string> <vector>)
  endif()
endfunction()

# Third-party libraries each room links. Every room may use fmt; the others stand where they are used.
set(ROOM_LIBS_core fmt::fmt OpenMP::OpenMP_CXX)
set(ROOM_LIBS_material Eigen3::Eigen)
set(ROOM_LIBS_geometry Eigen3::Eigen)
set(ROOM_LIBS_element Eigen3::Eigen)
set(ROOM_LIBS_section Eigen3::Eigen)
set(ROOM_LIBS_halfspace Eigen3::Eigen)
set(ROOM_LIBS_steady Eigen3::Eigen)
set(ROOM_LIBS_track Eigen3::Eigen)
set(ROOM_LIBS_curving Eigen3::Eigen)
if(RAILSTRATA_FFT STREQUAL "fftw")
  set(ROOM_LIBS_fft fftw3)
else()
  set(ROOM_LIBS_fft Eigen3::Eigen)
endif()
set(ROOM_LIBS_text tomlplusplus::tomlplusplus)
set(ROOM_LIBS_options nlohmann_json::nlohmann_json)
set(ROOM_LIBS_body Eigen3::Eigen)
set(ROOM_LIBS_fem Eigen3::Eigen)
set(ROOM_LIBS_calibrate Eigen3::Eigen)
if(NOT WIN32)
  set(ROOM_LIBS_hdf5 hdf5::hdf5 hdf5::hdf5_hl)
endif()
set(ROOM_LIBS_record nlohmann_json::nlohmann_json ZLIB::ZLIB)
set(ROOM_LIBS_app spdlog::spdlog CLI11::CLI11)

# Products of complex numbers in kiss FFT without a look at every one for NaN: else it is three times slower.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/laws/fft/fft_kiss.cpp PROPERTIES COMPILE_OPTIONS -fcx-limited-range)
else()
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/laws/fft/fft_kiss.cpp PROPERTIES COMPILE_OPTIONS -ffast-math)
endif()

# The live contact computes in every time step of a vehicle, in a room that else asks others.
foreach(source next_start patch_forces wheelset wheelset_height wheelset_lean)
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/work/ask/${source}.cpp PROPERTIES
    COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
endforeach()

# Sources with the kernels of the explicit step. g++ before 13 takes a Zen 4 for a Zen 3 and schedules for vectors of
# half the width: the kernel loses up to 15 %. The option stays on these files alone, because it also decides where
# products and sums are fused, which shows in the last bits of a result.
set(ROOM_WIDE_VECTOR_SOURCES src/engines/body/traversal.cpp)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
    AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  foreach(source IN LISTS ROOM_WIDE_VECTOR_SOURCES)
    if(NOT EXISTS ${CMAKE_SOURCE_DIR}/${source})
      message(FATAL_ERROR "${source} is gone: name the file with the step's kernels in ROOM_WIDE_VECTOR_SOURCES "
        "(cmake/rooms.cmake)")
    endif()
    set_source_files_properties(${CMAKE_SOURCE_DIR}/${source} PROPERTIES
      COMPILE_OPTIONS "$<$<BOOL:$<TARGET_PROPERTY:WIDE_VECTORS>>:-mtune=icelake-server>")
  endforeach()
endif()

# railstrata_room(NAME FOLDER): one room of the variant whose suffix, wide_vectors and below stand in the caller, who says
# by `compiled` whether it is to be; its name goes into with_sources if it has any.
macro(railstrata_room name folder compiled)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  if(WIN32)  # <room>/windows/<file>.cpp stands in for <room>/<file>.cpp
    file(GLOB twins CONFIGURE_DEPENDS ${folder}/windows/*.cpp)
    foreach(twin IN LISTS twins)
      get_filename_component(file ${twin} NAME)
      list(REMOVE_ITEM sources ${folder}/${file})
    endforeach()
    set_source_files_properties(${twins} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # windows.h has macros
    list(APPEND sources ${twins})
  endif()
  list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/src/doors/app/main.cpp)
  foreach(fft fftw kiss)
    if(NOT fft STREQUAL RAILSTRATA_FFT)
      list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/src/laws/fft/fft_${fft}.cpp)
    endif()
  endforeach()
  if("${name}" STREQUAL "device" AND RAILSTRATA_WITH_CUDA)  # one object for all variants: nothing in it knows a pack
    list(REMOVE_ITEM sources ${folder}/no_card.cpp)
    list(APPEND sources ${RAILSTRATA_CARD_OBJECT})
    set_source_files_properties(${RAILSTRATA_CARD_OBJECT} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
  endif()
  set(room room_${name}${suffix})
  if(sources AND ${compiled})
    add_library(${room} STATIC ${sources})
    set_target_properties(${room} PROPERTIES WIDE_VECTORS ${wide_vectors})
    target_link_libraries(${room} PUBLIC railstrata_flags${suffix} ${below} ${ROOM_LIBS_${name}})
    railstrata_light(${room} ${name})
    if("${name}" STREQUAL "device" AND RAILSTRATA_WITH_CUDA)
      add_dependencies(${room} card_object)
      target_link_libraries(${room} PRIVATE ${RAILSTRATA_CUDART} Threads::Threads rt ${CMAKE_DL_LIBS})
    endif()
    list(APPEND with_sources ${name})
  else()
    add_library(${room} INTERFACE)
    target_link_libraries(${room} INTERFACE railstrata_flags${suffix} ${below} ${ROOM_LIBS_${name}})
  endif()
endmacro()

# Where #include "<extra>/..." is found, by the extras and by those that see them.
add_library(extras_headers INTERFACE)
target_include_directories(extras_headers INTERFACE ${CMAKE_SOURCE_DIR}/extras)

# railstrata_rooms(VARIANT WIDE_VECTORS [room]...): the rooms of a variant; "" is the developer's build, whose targets
# have no suffix. Rooms, if given, are all that is compiled. Sets ROOMS<suffix> to the names of rooms with sources, lowest
# first and extras last, and EXTRAS to the names of those, in the caller's scope.
function(railstrata_rooms variant wide_vectors)
  set(suffix "")
  if(variant)
    set(suffix "_${variant}")
  endif()
  set(below "")
  set(with_sources "")
  foreach(floor IN LISTS FLOORS)
    string(REPLACE " " ";" names "${floor}")
    set(this_floor "")
    foreach(name IN LISTS names)
      set(compiled YES)
      if(ARGN AND NOT name IN_LIST ARGN)
        set(compiled NO)
      endif()
      railstrata_room(${name} ${CMAKE_SOURCE_DIR}/src/${WING_OF_${name}}/${name} ${compiled})
      list(APPEND this_floor room_${name}${suffix})
    endforeach()
    list(PREPEND below ${this_floor})
    foreach(name IN LISTS names)
      set(below_and_${name} ${below})
    endforeach()
  endforeach()

  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/LAYERS
    ${CMAKE_SOURCE_DIR}/extras/LAYERS)
  set(extras "")
  file(STRINGS ${CMAKE_SOURCE_DIR}/extras/LAYERS lines REGEX "^[a-z]")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([a-z0-9_]+) above ([a-z0-9]+)( seen by (.*))?$" line "${line}")
    set(name ${CMAKE_MATCH_1})
    set(floor ${CMAKE_MATCH_2})
    string(REPLACE " " ";" users "${CMAKE_MATCH_4}")
    if(EXISTS ${CMAKE_SOURCE_DIR}/extras/${name}/CMakeLists.txt)
      continue()
    endif()
    set(compiled YES)
    if(ARGN AND NOT name IN_LIST ARGN)
      set(compiled NO)
    endif()
    set(below ${below_and_${floor}} extras_headers)
    railstrata_room(${name} ${CMAKE_SOURCE_DIR}/extras/${name} ${compiled})
    foreach(user IN LISTS users)
      get_target_property(kind room_${user}${suffix} TYPE)
      string(REPLACE STATIC_LIBRARY PUBLIC kind ${kind})
      string(REPLACE INTERFACE_LIBRARY INTERFACE kind ${kind})
      target_link_libraries(room_${user}${suffix} ${kind} room_${name}${suffix})
    endforeach()
    list(APPEND extras ${name})
  endforeach()
  set(ROOMS${suffix} ${with_sources} PARENT_SCOPE)
  set(EXTRAS ${extras} PARENT_SCOPE)
endfunction()
