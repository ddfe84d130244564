# The shared library as CONTACT's Python interface calls it.
if(RAILSTRATA_LIBRARY)
  railstrata_python_test(cntc:ctypes SLOW ${CMAKE_CURRENT_LIST_DIR}/contact_test.py $<TARGET_FILE:contact_addon>
    ${CMAKE_SOURCE_DIR}/extras/cntc/railstrata_cntc.h ${CMAKE_SOURCE_DIR}/tests/data/reference)
  add_test(NAME cntc:wheel COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/contact_wheel_test.py
    $<TARGET_FILE:contact_addon> ${CMAKE_SOURCE_DIR}/tests/data/reference)
  add_test(NAME cntc:exported COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/exported_test.py
    $<TARGET_FILE:contact_addon> $<TARGET_FILE:railstrata>)
  set_tests_properties(cntc:wheel cntc:exported PROPERTIES TIMEOUT 600 ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
  set_tests_properties(cntc:ctypes PROPERTIES LABELS extras)
  set_tests_properties(cntc:ctypes_slow cntc:wheel cntc:exported PROPERTIES LABELS "extras;slow")
endif()
