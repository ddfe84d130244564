# What is passed on for Windows: the program, the C library and CONTACT's interface, each with all it needs inside but
# for what every Windows has, and `cpack -G ZIP`, which puts them into one folder.
set(utf8_letters ${CMAKE_SOURCE_DIR}/src/base/core/windows/utf8_letters.cpp)
set(utf8_wraps -Wl,--wrap=mbrtowc -Wl,--wrap=wcrtomb)
add_executable(railstrata src/doors/app/windows/main.cpp ${utf8_letters})
target_link_libraries(railstrata PRIVATE room_app)
target_link_options(railstrata PRIVATE -Wl,--stack,8388608 ${utf8_wraps})  # bytes of the stack, as on Linux
# The programs of a folder and their data lie side by side.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/doors/app/shipped_files.cpp PROPERTIES
  COMPILE_DEFINITIONS RAILSTRATA_DATA_FROM_PROGRAM=".")

# railstrata_dll(TARGET ROOM HEADER): a DLL of a room and what it needs. It exports the functions of the header.
function(railstrata_dll target room header)
  file(STRINGS ${header} names REGEX "^[A-Z]+_API ")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  list(TRANSFORM names REPLACE "^[^(]*[ *]([a-z0-9_]+)\\(.*" "  \\1")
  list(JOIN names "\n" names)
  set(exports ${CMAKE_BINARY_DIR}/generated/${target}.def)
  file(CONFIGURE OUTPUT ${exports} CONTENT "EXPORTS\n${names}\n" @ONLY)
  add_library(${target} SHARED $<TARGET_OBJECTS:room_${room}> ${CMAKE_SOURCE_DIR}/src/base/core/windows/stay_loaded.cpp
    ${utf8_letters} ${exports})
  target_link_libraries(${target} PRIVATE room_${room})
  target_link_options(${target} PRIVATE ${utf8_wraps})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX PREFIX "" IMPORT_PREFIX "" IMPORT_SUFFIX ".lib")
endfunction()
set(c_header ${CMAKE_SOURCE_DIR}/src/doors/capi/railstrata.h)
set(contact_header ${CMAKE_SOURCE_DIR}/extras/cntc/railstrata_cntc.h)
railstrata_dll(railstrata_library capi ${c_header})
set_target_properties(railstrata_library PROPERTIES OUTPUT_NAME railstrata)
railstrata_dll(contact_addon cntc ${contact_header})
set_target_properties(contact_addon PROPERTIES OUTPUT_NAME contact_addon_win64)

# What is inside and whose it is.
set(licences ${CMAKE_BINARY_DIR}/generated/THIRD-PARTY.txt)
set(text "Third-party software in these files, with its licences.\n")
foreach(package libfmt-dev libspdlog-dev libcli11-dev nlohmann-json3-dev libtomlplusplus-dev libeigen3-dev
    libz-mingw-w64-dev mingw-w64-x86-64-dev g++-mingw-w64-x86-64-posix)
  file(READ /usr/share/doc/${package}/copyright licence)
  string(REPEAT "=" 80 line)
  string(APPEND text "\n${line}\n${package}\n\n${licence}")
endforeach()
file(WRITE ${licences} "${text}")

install(TARGETS railstrata railstrata_library RUNTIME DESTINATION . ARCHIVE DESTINATION .)
install(TARGETS contact_addon RUNTIME DESTINATION contact)
install(FILES ${c_header} ${contact_header} DESTINATION include/railstrata)
install(FILES ${CMAKE_BINARY_DIR}/generated/railstrata_library.def RENAME railstrata.def DESTINATION .)
install(FILES ${CMAKE_SOURCE_DIR}/tests/install/consumer/mine.c DESTINATION examples)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/cases DESTINATION . PATTERN "recorded" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/cases/paper/recorded/study/study.csv DESTINATION cases/paper/recorded/study)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/data ${CMAKE_SOURCE_DIR}/matlab DESTINATION .)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION . FILES_MATCHING PATTERN "*.md" PATTERN "*.bib" PATTERN "*.png"
  PATTERN "*.svg" PATTERN "reliability" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/CHANGELOG.md
  ${CMAKE_SOURCE_DIR}/CITATION.cff ${licences} DESTINATION .)
set(CPACK_GENERATOR ZIP)
set(CPACK_PACKAGE_FILE_NAME railstrata-${PROJECT_VERSION}-win64)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
