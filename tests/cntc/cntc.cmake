# The shared library as CONTACT's Python interface calls it.
if(RAILSTRATA_LIBRARY)
  add_test(NAME cntc:ctypes COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/cntc/contact_test.py
    $<TARGET_FILE:contact_addon> ${CMAKE_SOURCE_DIR}/src/cntc/railstrata_cntc.h
    ${CMAKE_SOURCE_DIR}/tests/data/reference)
  add_test(NAME cntc:exported COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/cntc/exported_test.py
    $<TARGET_FILE:contact_addon> $<TARGET_FILE:railstrata>)
  set_tests_properties(cntc:ctypes cntc:exported PROPERTIES TIMEOUT 600 ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()
