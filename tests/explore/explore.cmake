# The explorer: built from its sources as they stand, and as a reader meets it.
set(here ${CMAKE_SOURCE_DIR}/tests/explore)
add_test(NAME explore:bundle COMMAND /usr/bin/python3 ${here}/bundle_test.py ${CMAKE_SOURCE_DIR})
add_test(NAME explore:written COMMAND /usr/bin/python3 ${here}/written_test.py $<TARGET_FILE:railstrata>
  ${CMAKE_SOURCE_DIR})
railstrata_python_test(explore:page SLOW ${here}/page_test.py $<TARGET_FILE:railstrata> ${CMAKE_SOURCE_DIR})
set_tests_properties(explore:page PROPERTIES COST 35)
