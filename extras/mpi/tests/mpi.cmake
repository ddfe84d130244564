# One run by several processes; skipped where there is no MPI.
railstrata_python_test(mpi:ranks SLOW ${CMAKE_CURRENT_LIST_DIR}/ranks_test.py $<TARGET_FILE:railstrata>)
set_tests_properties(mpi:ranks mpi:ranks_slow PROPERTIES TIMEOUT 3600 PROCESSORS 2)
set_tests_properties(mpi:ranks PROPERTIES LABELS extras)
set_tests_properties(mpi:ranks_slow PROPERTIES LABELS "extras;slow")
