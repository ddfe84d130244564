# Parts that a machine may lack: ranks over MPI, cards, the Python package, the benchmarks. Each says in one line what it
# is, for CMake's output and for `railstrata info`: there; not there, with what to install; or half there, where
# something of it is installed and does not work.
#
# A build folder takes up what is installed later: what was not found is looked for again whenever CMake runs, and CMake
# runs again when Debian's list of packages has changed.
if(EXISTS /var/lib/dpkg/status AND NOT CMAKE_SCRIPT_MODE_FILE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS /var/lib/dpkg/status)
endif()
set(RAILSTRATA_PARTS_FILE ${CMAKE_BINARY_DIR}/generated/parts.txt)
if(NOT CMAKE_SCRIPT_MODE_FILE)
  file(WRITE ${RAILSTRATA_PARTS_FILE} "")
endif()

# railstrata_optional_part(NAME TEXT)
function(railstrata_optional_part name text)
  message(STATUS "${name}: ${text}")
  file(APPEND ${RAILSTRATA_PARTS_FILE} "${name}|${text}\n")
endfunction()

# railstrata_probe_mpi(FOLDER OUT): OUT is empty if MPI's compiler compiles a program with mpi.h, else what is missing.
# Asked before FindMPI, because Debian's openmpi-bin, which other packages bring along, has that compiler without the
# headers of libopenmpi-dev; FindMPI takes it and then stops CMake, QUIET or not.
function(railstrata_probe_mpi folder out)
  set(${out} "" PARENT_SCOPE)
  set(packages "apt-get install libopenmpi-dev openmpi-bin")
  find_program(mpi_compiler NAMES mpicc NO_CACHE)
  if(NOT mpi_compiler)
    set(${out} "not there: ${packages}" PARENT_SCOPE)
    return()
  endif()
  file(WRITE ${folder}/mpi_probe.c "#include <mpi.h>\nint main(void) { int is; return MPI_Initialized(&is); }\n")
  execute_process(COMMAND ${mpi_compiler} ${folder}/mpi_probe.c -o ${folder}/mpi_probe
    RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed)
    set(${out} "half there: ${mpi_compiler} cannot compile a program with mpi.h (${packages})" PARENT_SCOPE)
  endif()
endfunction()

# railstrata_find_mpi(): MPI::MPI_C, if it is wanted and there.
macro(railstrata_find_mpi)
  set(mpi_missing "left out by RAILSTRATA_MPI=OFF")
  if(NOT RAILSTRATA_MPI STREQUAL "OFF")
    railstrata_probe_mpi(${CMAKE_BINARY_DIR}/generated mpi_missing)
  endif()
  if(NOT mpi_missing)
    if(NOT MPI_C_FOUND)  # what an earlier look has left in the cache is of another machine, so to speak
      get_cmake_property(cached CACHE_VARIABLES)
      list(FILTER cached INCLUDE REGEX "^MPI_")
      foreach(name IN LISTS cached)
        unset(${name} CACHE)
      endforeach()
    endif()
    find_package(MPI QUIET COMPONENTS C)
    if(NOT MPI_C_FOUND)
      set(mpi_missing "half there: CMake's FindMPI does not find what mpicc compiles with")
    endif()
  endif()
  if(NOT mpi_missing)
    railstrata_optional_part(ranks "there (MPI ${MPI_C_VERSION})")
  elseif(RAILSTRATA_MPI STREQUAL "ON")
    message(FATAL_ERROR "RAILSTRATA_MPI is ON and MPI is ${mpi_missing}")
  else()
    railstrata_optional_part(ranks "${mpi_missing}")
  endif()
endmacro()
