# The card: extras/device/card.cu, compiled by nvcc alone and linked as an object into the extra device. nvcc is never
# required: with AUTO a machine without one, or with one that cannot read the kernels, builds the program without a card.
#   RAILSTRATA_CUDA           OFF (the default: kernels take a minute to compile), AUTO, ON (an error says what is missing)
#   RAILSTRATA_NVCC           the compiler
#   RAILSTRATA_CUDA_ARCHITECTURES   e.g. "80;90"; the last one's intermediate code is kept for newer cards
set(RAILSTRATA_CUDA OFF CACHE STRING "Build for NVIDIA cards: OFF, AUTO (if nvcc is found and works), ON")
set_property(CACHE RAILSTRATA_CUDA PROPERTY STRINGS AUTO ON OFF)
set(RAILSTRATA_CUDA_ARCHITECTURES "80;90" CACHE STRING "Compute capabilities that kernels are compiled for")
find_program(RAILSTRATA_NVCC nvcc HINTS /usr/local/cuda/bin ENV CUDA_HOME ENV CUDA_PATH PATH_SUFFIXES bin)


set(cuda_missing "")
if(NOT RAILSTRATA_NVCC)
  set(cuda_missing "not there: no nvcc (-DRAILSTRATA_NVCC=FILE names one)")
elseif(NOT RAILSTRATA_CUDA)
  set(cuda_missing "not asked for: RAILSTRATA_CMAKE=-DRAILSTRATA_CUDA=AUTO ./railstrata info builds it")
elseif(RAILSTRATA_CUDA STREQUAL "AUTO" AND (RAILSTRATA_SANITIZE OR RAILSTRATA_COVERAGE OR RAILSTRATA_FUZZ))
  set(cuda_missing "left out: an instrumented build runs the kernels on the processor")
endif()

set(cuda_architectures "")
foreach(architecture IN LISTS RAILSTRATA_CUDA_ARCHITECTURES)
  list(APPEND cuda_architectures -gencode arch=compute_${architecture},code=sm_${architecture})
endforeach()
list(GET RAILSTRATA_CUDA_ARCHITECTURES -1 architecture)
list(APPEND cuda_architectures -gencode arch=compute_${architecture},code=compute_${architecture})
set(cuda_flags -std=c++20 --expt-relaxed-constexpr -O3 -ccbin ${CMAKE_CXX_COMPILER} -I ${CMAKE_SOURCE_DIR}/extras -Xcompiler -fPIC -DNDEBUG)

foreach(wing IN LISTS WING_FOLDERS)
  list(APPEND cuda_flags -I ${wing})
endforeach()

if(NOT cuda_missing)
  get_filename_component(nvcc_file ${RAILSTRATA_NVCC} REALPATH)
  get_filename_component(cuda_root ${nvcc_file}/../.. ABSOLUTE)
  find_library(RAILSTRATA_CUDART cudart_static
    HINTS ${cuda_root}/lib64 ${cuda_root}/targets/x86_64-linux/lib ${cuda_root}/lib NO_DEFAULT_PATH)
  if(NOT RAILSTRATA_CUDART)
    set(cuda_missing "half there: libcudart_static.a is not beside ${RAILSTRATA_NVCC}")
  endif()
endif()
if(NOT cuda_missing AND NOT RAILSTRATA_NVCC_WORKS STREQUAL "${nvcc_file}")  # once: does it read the kernels?
  set(probe ${CMAKE_BINARY_DIR}/cuda_probe.cu)
  file(WRITE ${probe} "#include \"device/kernel_list.hpp\"\n__global__ void probe(int* x) { *x = 1; }\n")
  execute_process(COMMAND ${RAILSTRATA_NVCC} ${cuda_flags} ${cuda_architectures} -c ${probe} -o ${probe}.o
    RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    set(cuda_missing "half there: ${RAILSTRATA_NVCC} cannot compile the kernels (${probe})")
    message(STATUS "${said}")
  else()
    set(RAILSTRATA_NVCC_WORKS ${nvcc_file} CACHE INTERNAL "")
  endif()
endif()

if(NOT cuda_missing)
  set(RAILSTRATA_WITH_CUDA ON)
  railstrata_optional_part(cards "there (${RAILSTRATA_NVCC}, compute capability ${RAILSTRATA_CUDA_ARCHITECTURES})")
  set(RAILSTRATA_CARD_OBJECT ${CMAKE_BINARY_DIR}/card.o)
  add_custom_command(OUTPUT ${RAILSTRATA_CARD_OBJECT}
    COMMAND ${RAILSTRATA_NVCC} ${cuda_flags} ${cuda_architectures} -MD -MF ${CMAKE_BINARY_DIR}/card.d
      -c ${CMAKE_SOURCE_DIR}/extras/device/card.cu -o ${RAILSTRATA_CARD_OBJECT}
    DEPENDS ${CMAKE_SOURCE_DIR}/extras/device/card.cu DEPFILE ${CMAKE_BINARY_DIR}/card.d
    COMMENT "Compiling the kernels for cards" VERBATIM)
  add_custom_target(card_object DEPENDS ${RAILSTRATA_CARD_OBJECT})
elseif(RAILSTRATA_CUDA AND NOT RAILSTRATA_CUDA STREQUAL "AUTO")
  message(FATAL_ERROR "RAILSTRATA_CUDA is ON and cards are ${cuda_missing}")
else()
  set(RAILSTRATA_WITH_CUDA OFF)
  railstrata_optional_part(cards "${cuda_missing}")
endif()
