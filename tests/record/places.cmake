# A number of the summary is said once.
railstrata_python_test(record:places ${CMAKE_SOURCE_DIR}/tests/record/places_test.py $<TARGET_FILE:railstrata>
  ${CMAKE_SOURCE_DIR})
