# `cmake --install`, and the files of the Debian packages: the same files in two layouts, a prefix that can be moved and
# Debian's folders. Targets and their variables stand in cmake/library.cmake.
set(package_build ${CMAKE_BINARY_DIR}/package)

find_program(GZIP gzip REQUIRED)
configure_file(${CMAKE_SOURCE_DIR}/packaging/railstrata.1.in ${package_build}/railstrata.1 @ONLY)
execute_process(COMMAND sh -c "${GZIP} -9nc railstrata.1 > railstrata.1.gz" WORKING_DIRECTORY ${package_build}
  COMMAND_ERROR_IS_FATAL ANY)

# Of a part of the files: its component. Those of Debian's layout are installed on demand alone.
macro(railstrata_part name)
  set(part COMPONENT ${layout}${name})
  if(layout)
    list(APPEND part EXCLUDE_FROM_ALL)
  endif()
endmacro()

function(railstrata_install_libraries layout libdir)
  railstrata_part(library)
  set(library_part ${part})
  railstrata_part(dev)
  set(dev_part ${part})
  install(TARGETS railstrata_library${installed_suffix} EXPORT ${layout}RailStrataTargets
    LIBRARY DESTINATION ${libdir} ${library_part} NAMELINK_COMPONENT ${layout}dev
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  railstrata_part(program)
  install(TARGETS railstrata_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} ${part})
  install(TARGETS railstrata_commands LIBRARY DESTINATION ${libdir} ${part} NAMELINK_SKIP)
  install(TARGETS railstrata_hdf5 LIBRARY DESTINATION ${libdir} ${library_part} NAMELINK_SKIP)
  install(TARGETS contact_addon LIBRARY DESTINATION ${libdir}/railstrata/contact ${library_part})
  foreach(level IN LISTS levels)
    install(TARGETS railstrata_library_${level} LIBRARY DESTINATION ${libdir}/${hwcaps}/x86-64-${level} ${library_part}
      NAMELINK_SKIP)
  endforeach()
endfunction()

function(railstrata_install_headers layout libdir)
  railstrata_part(dev)
  install(FILES ${CMAKE_SOURCE_DIR}/extras/${ROOM_OF_CONTACT}/railstrata_cntc.h
    ${CMAKE_SOURCE_DIR}/src/doors/capi/railstrata.f90
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/railstrata ${part})
  install(DIRECTORY ${public_include}/railstrata DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${part}
    FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
  set(package_folder ${libdir}/cmake/RailStrata)
  install(EXPORT ${layout}RailStrataTargets FILE RailStrataTargets.cmake NAMESPACE RailStrata::
    DESTINATION ${package_folder} ${part})
  install(FILES ${package_build}/RailStrataConfig.cmake ${package_build}/RailStrataConfigVersion.cmake
    DESTINATION ${package_folder} ${part})
  # Both paths of the file are relative to the file itself, so that the folder can be moved.
  file(RELATIVE_PATH root_from_pc /prefix/${libdir}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" root_from_pc "${root_from_pc}")
  configure_file(${CMAKE_SOURCE_DIR}/cmake/railstrata.pc.in ${package_build}/${layout}pc/railstrata.pc @ONLY)
  install(FILES ${package_build}/${layout}pc/railstrata.pc DESTINATION ${libdir}/pkgconfig ${part})
endfunction()

# Shipped cases; of the recorded results of a study the table that a validation set reads; profiles, the script for ParaView, texts.
function(railstrata_install_data layout)
  railstrata_part(program)
  set(data_folder ${CMAKE_INSTALL_DATADIR}/railstrata)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/cases DESTINATION ${data_folder} ${part} PATTERN "recorded" EXCLUDE)
  set(study cases/paper/recorded/study)
  install(FILES ${CMAKE_SOURCE_DIR}/${study}/study.csv DESTINATION ${data_folder}/${study} ${part})
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/data DESTINATION ${data_folder} ${part})
  install(FILES ${CMAKE_SOURCE_DIR}/tests/install/consumer/mine.c ${CMAKE_SOURCE_DIR}/tests/install/consumer/mine.f90
    DESTINATION ${data_folder}/examples ${part})
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples/vehicle DESTINATION ${data_folder}/examples ${part})
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/matlab DESTINATION ${data_folder} ${part})
  install(FILES ${CMAKE_SOURCE_DIR}/src/results/report/view.py ${CMAKE_SOURCE_DIR}/web/dist/report.js
    ${CMAKE_SOURCE_DIR}/web/dist/report.css DESTINATION ${data_folder}/report ${part})
  set(doc ${CMAKE_INSTALL_DATADIR}/doc/railstrata)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/ DESTINATION ${doc} ${part} FILES_MATCHING PATTERN "*.md"
    PATTERN "*.bib" PATTERN "*.png" PATTERN "*.svg" PATTERN "*.ipynb" PATTERN "reliability" EXCLUDE)
  install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CITATION.cff DESTINATION ${doc} ${part})
  if(NOT layout)  # Debian has them under names of its own
    install(FILES ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/CHANGELOG.md DESTINATION ${doc} ${part})
  endif()
  install(FILES ${package_build}/railstrata.1.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/man/man1 ${part})
endfunction()

function(railstrata_install_python layout libdir folder)
  railstrata_part(python)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/railstrata/*.py
    ${CMAKE_SOURCE_DIR}/python/railstrata/py.typed)
  install(FILES ${files} DESTINATION ${folder}/railstrata ${part})
  install(TARGETS python_bridge LIBRARY DESTINATION ${folder}/railstrata ${part})
  install(TARGETS railstrata_bridge LIBRARY DESTINATION ${libdir} ${part} NAMELINK_SKIP)
endfunction()

# railstrata_install(LAYOUT LIBDIR PYTHON): all of it. LAYOUT: "" or the beginning of the components' names.
function(railstrata_install layout libdir python_folder)
  railstrata_install_libraries("${layout}" ${libdir})
  railstrata_install_headers("${layout}" ${libdir})
  railstrata_install_data("${layout}")
  railstrata_install_python("${layout}" ${libdir} ${python_folder})
  if(TARGET railstrata_mpi)  # where the program looks for it: src/doors/app/mpi_ranks.cpp
    railstrata_part(mpi)
    install(TARGETS railstrata_mpi LIBRARY DESTINATION lib/railstrata ${part})
  endif()
endfunction()

file(WRITE ${package_build}/RailStrataConfig.cmake
  "# find_package(RailStrata): the target RailStrata::railstrata\n"
  "include(\"\${CMAKE_CURRENT_LIST_DIR}/RailStrataTargets.cmake\")\n")
write_basic_package_version_file(${package_build}/RailStrataConfigVersion.cmake COMPATIBILITY SameMinorVersion)
target_compile_features(railstrata_library${installed_suffix} INTERFACE cxx_std_20)

# Where libraries look for each other, seen from their own folder: the tree can be moved.
set(python_folder ${CMAKE_INSTALL_LIBDIR}/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages
  CACHE STRING "Folder of the Python package below the prefix: that of users (~/.local) and virtual environments")
set_target_properties(railstrata_library${installed_suffix} railstrata_commands railstrata_bridge railstrata_hdf5
  PROPERTIES INSTALL_RPATH "$ORIGIN")
foreach(level IN LISTS levels)  # the plug-in stands beside the library of all processors
  set_target_properties(railstrata_library_${level} PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/../..")
endforeach()
# of a prefix, and of a wheel, whose libraries stand in the package
file(RELATIVE_PATH lib_from_python /prefix/${python_folder}/railstrata /prefix/${CMAKE_INSTALL_LIBDIR})
set_target_properties(python_bridge PROPERTIES INSTALL_RPATH "$ORIGIN/lib;$ORIGIN/${lib_from_python}")

# A tree of which only a part was built, as ./railstrata run leaves it, is built as far as it is installed.
set(to_install railstrata_library${installed_suffix} railstrata_program railstrata_commands railstrata_hdf5 contact_addon
  python_bridge railstrata_bridge)
foreach(level IN LISTS levels)
  list(APPEND to_install railstrata_library_${level})
endforeach()
if(TARGET railstrata_mpi)
  list(APPEND to_install railstrata_mpi)
endif()
add_custom_target(to_install DEPENDS ${to_install} public_headers)
list(TRANSFORM to_install REPLACE "(.+)" "\"$<TARGET_FILE:\\1>\"" OUTPUT_VARIABLE installed_files)
list(JOIN installed_files " " installed_files)
install(CODE "foreach(file IN ITEMS ${installed_files} \"${headers_stamp}\")
  if(NOT EXISTS \"\${file}\")
    message(STATUS \"Building what is installed and not built yet\")
    execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${CMAKE_BINARY_DIR}\" --target to_install
      COMMAND_ERROR_IS_FATAL ANY)
    break()
  endif()
endforeach()" ALL_COMPONENTS)

railstrata_install("" ${CMAKE_INSTALL_LIBDIR} ${python_folder})

if(RAILSTRATA_NATIVE AND NOT RAILSTRATA_VARIANTS)
  install(CODE "message(WARNING \"This build runs on processors like this one only. For others build with \"
    \"-DRAILSTRATA_VARIANTS=ON (cmake --preset install, or ./railstrata install PREFIX).\")")
endif()
