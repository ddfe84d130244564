# What is passed on for Windows, made by mingw-w64 and run by wine; skipped by name where either is missing.
if(RAILSTRATA_LIBRARY AND NOT RAILSTRATA_SANITIZE AND NOT RAILSTRATA_COVERAGE)
  set(windows_test /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/windows_test.py)
  add_test(NAME windows:build COMMAND ${windows_test} build ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/windows)
  set_tests_properties(windows:build PROPERTIES FIXTURES_SETUP windows TIMEOUT 3000 PROCESSORS 2)
  foreach(what Program Library Contact)
    string(TOLOWER ${what} name)
    add_test(NAME windows:${name} COMMAND ${windows_test} run ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/windows
      $<TARGET_FILE:railstrata_library${installed_suffix}> $<TARGET_FILE:contact_addon> ${what})
    set_tests_properties(windows:${name} PROPERTIES FIXTURES_REQUIRED windows TIMEOUT 900 RESOURCE_LOCK wine)
  endforeach()
  set_tests_properties(windows:build windows:program windows:library windows:contact PROPERTIES LABELS windows
    SKIP_RETURN_CODE 77 ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1")
endif()
