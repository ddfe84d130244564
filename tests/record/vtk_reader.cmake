# The samples written by the Vtk tests, read back by VTK itself. Skipped (77) where VTK's Python modules are missing.
set(samples ${CMAKE_CURRENT_BINARY_DIR}/vtk_samples)
add_test(NAME record:vtk_samples COMMAND test_record --gtest_filter=Vtk.samples_for_the_reader_are_written_whole)
add_test(NAME record:vtk_reader COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/record/read_vtk.py ${samples})
set_tests_properties(record:vtk_samples PROPERTIES FIXTURES_SETUP vtk_samples ENVIRONMENT RAILSTRATA_VTK_SAMPLES=${samples})
set_tests_properties(record:vtk_reader PROPERTIES FIXTURES_REQUIRED vtk_samples SKIP_RETURN_CODE 77)
