# Debian packages by `cpack -G DEB` in a build folder (packaging/README.md):
#
#   railstrata               the program, its commands, cases and profiles, manual page
#   librailstrata0.4         librailstrata.so and CONTACT's interface
#   librailstrata-dev        headers, CMake package, pkg-config
#   python3-railstrata       the Python package
#   railstrata-mpi           the plug-in for runs over Open MPI (with RAILSTRATA_MPI)
#
# Their files are those of `cmake --install` in Debian's folders, without the paths that libraries of a prefix have.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(NOT DPKG_SHLIBDEPS OR NOT CMAKE_LIBRARY_ARCHITECTURE)
  return()  # not Debian
endif()
set(RAILSTRATA_MAINTAINER "The RailStrata authors <maintainer@railstrata.example.org>" CACHE STRING
  "Name and address of who makes the packages")
set(debian_lib ${CMAKE_INSTALL_LIBDIR})
if(NOT debian_lib MATCHES "${CMAKE_LIBRARY_ARCHITECTURE}$")
  set(debian_lib lib/${CMAKE_LIBRARY_ARCHITECTURE})
endif()
railstrata_install(deb- ${debian_lib} lib/python3/dist-packages)

set(debian ${package_build}/debian)
file(MAKE_DIRECTORY ${debian})
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${debian}/changelog.Debian "railstrata (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n"
  "  * Release ${PROJECT_VERSION}: see changelog.gz.\n\n -- ${RAILSTRATA_MAINTAINER}  ${now}\n")
execute_process(COMMAND sh -c "${GZIP} -9nc changelog.Debian > changelog.Debian.gz && \
${GZIP} -9nc ${CMAKE_SOURCE_DIR}/CHANGELOG.md > changelog.gz" WORKING_DIRECTORY ${debian} COMMAND_ERROR_IS_FATAL ANY)

# debian_package(PART NAME DEPENDS SECTION SUMMARY TEXT)
macro(debian_package part name depends section summary text)
  list(APPEND CPACK_COMPONENTS_ALL deb-${part})
  string(TOUPPER "deb-${part}" id)
  set(CPACK_DEBIAN_${id}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${id}_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_${id}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${id}_PACKAGE_SECTION ${section})
  if(NOT "${part}" STREQUAL "dev")  # has shared libraries: the loader's list is made anew
    set(CPACK_DEBIAN_${id}_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/packaging/triggers)
  endif()
  set(CPACK_COMPONENT_${id}_DESCRIPTION "${summary}\n${text}")
  set(CPACK_DEBIAN_${id}_DESCRIPTION "${summary}\n${text}")
  install(FILES ${CMAKE_SOURCE_DIR}/packaging/copyright ${debian}/changelog.Debian.gz ${debian}/changelog.gz
    DESTINATION share/doc/${name} COMPONENT deb-${part} EXCLUDE_FROM_ALL)
endmacro()

# debian_shlibs(PART NAME SONAME...): the package has these libraries. CPack's own table has a line for every file, and
# libraries for several processors are three files of one name.
macro(debian_shlibs part name)
  file(WRITE ${debian}/${part}/shlibs "")
  foreach(soname ${ARGN})
    file(APPEND ${debian}/${part}/shlibs "${soname} ${so_version} ${name} (= ${PROJECT_VERSION}-1)\n")
  endforeach()
  string(TOUPPER "deb-${part}" id)
  list(APPEND CPACK_DEBIAN_${id}_PACKAGE_CONTROL_EXTRA ${debian}/${part}/shlibs)
endmacro()

set(CPACK_COMPONENTS_ALL "")
set(library_package librailstrata${so_version})
set(about "Rolling contact of a wheel on a rail whose surface carries layers: contact\npressure, shear, stick and slip, \
creepage and the stresses below the\nsurface, by finite elements and by Kalker's theory on layered half-spaces.")
set(same "(= ${PROJECT_VERSION}-1)")
debian_package(library ${library_package} "" libs "rolling contact of layered rails - library"
  "${about}\nThis package has the shared library and CONTACT's interface to it.")
debian_shlibs(library ${library_package} librailstrata librailstrata-hdf5)
# zlib is inside on purpose: the library needs the compiler's own libraries alone (docs/library.md).
file(WRITE ${debian}/overrides "${library_package}: embedded-library zlib *\n")
install(FILES ${debian}/overrides DESTINATION share/lintian/overrides RENAME ${library_package}
  COMPONENT deb-library EXCLUDE_FROM_ALL)
debian_package(program railstrata "${library_package} ${same}" science "rolling contact of a wheel on a layered rail"
  "${about}\nThis package has the program with its cases, profiles and manual.")
debian_shlibs(program railstrata librailstrata-commands)
debian_package(dev librailstrata-dev "${library_package} ${same}" libdevel
  "rolling contact of layered rails - headers" "${about}\nThis package has the headers for C, C++ and Fortran programs.")
debian_package(python python3-railstrata "${library_package} ${same}, python3 (>= 3.9), python3-numpy" python
  "rolling contact of layered rails - Python 3" "${about}\nThis package has the Python package of the same name.")
debian_shlibs(python python3-railstrata librailstrata-bridge)
list(APPEND CPACK_DEBIAN_DEB-PYTHON_PACKAGE_CONTROL_EXTRA
  ${CMAKE_SOURCE_DIR}/packaging/postinst ${CMAKE_SOURCE_DIR}/packaging/prerm)
set(CPACK_DEBIAN_DEB-PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, python3-pandas, python3-xarray")
if(TARGET railstrata_mpi)
  debian_package(mpi railstrata-mpi "railstrata ${same}" science "rolling contact of a layered rail - runs over MPI"
    "${about}\nThis package has the plug-in that shares one run among processes by Open MPI.")
  set(CPACK_DEBIAN_DEB-MPI_PACKAGE_RECOMMENDS openmpi-bin)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME railstrata)
set(CPACK_PACKAGE_VENDOR "The RailStrata authors")
set(CPACK_PACKAGE_CONTACT "${RAILSTRATA_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${RAILSTRATA_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${libraries_folder})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};railstrata;ALL;/")
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/packaging/debian_tree.cmake)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
include(CPack)
