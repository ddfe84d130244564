# The documentation as a site: built strictly, and looked at.
add_test(NAME site COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/site/site_test.py ${CMAKE_SOURCE_DIR}
  ${CMAKE_CURRENT_BINARY_DIR}/site)
set_tests_properties(site PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 LABELS slow)
