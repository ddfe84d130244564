# The script of `study --batch slurm` in a real Slurm, with daemons of the test's own.
set(here ${CMAKE_CURRENT_LIST_DIR})
railstrata_python_test(batch:slurm ${here}/slurm_test.py $<TARGET_FILE:railstrata> ${CMAKE_SOURCE_DIR})
railstrata_python_test(batch:parallel ${here}/parallel_test.py $<TARGET_FILE:railstrata> $<TARGET_FILE:fault_injector>
  ${CMAKE_SOURCE_DIR})
# A minute and more, of daemons that come and go by their own clocks; and GNU parallel once ended with 0 without having
# started anything, on a busy machine, for a reason that is not known.
set_tests_properties(batch:slurm batch:parallel PROPERTIES LABELS "extras;long")
