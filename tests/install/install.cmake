# `cmake --install` into the build folder, once; then what is there, moved elsewhere and used by other programs.
if(RAILSTRATA_LIBRARY)
  set(here ${CMAKE_SOURCE_DIR}/tests/install)
  set(installed ${CMAKE_CURRENT_BINARY_DIR}/installed)
  set(install_test /usr/bin/python3 ${here}/install_test.py ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR} ${installed}
    ${CMAKE_COMMAND} ${CMAKE_CXX_COMPILER})
  add_test(NAME install:install COMMAND ${install_test} Install)
  set_tests_properties(install:install PROPERTIES FIXTURES_SETUP installed)
  foreach(group Tree Symbols Headers CMakeConsumer PkgConfigConsumer CConsumer Python Moved)
    add_test(NAME install:${group} COMMAND ${install_test} ${group})
    set_tests_properties(install:${group} PROPERTIES FIXTURES_REQUIRED installed)
  endforeach()
  set_tests_properties(install:Headers install:PkgConfigConsumer install:Moved PROPERTIES LABELS slow)
  foreach(group Wheel Tarball)
    add_test(NAME install:${group} COMMAND /usr/bin/python3 ${here}/wheel_test.py ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR}
      ${installed}/prefix ${CMAKE_CURRENT_BINARY_DIR}/packed_${group} ${group})
    set_tests_properties(install:${group} PROPERTIES FIXTURES_REQUIRED installed SKIP_RETURN_CODE 77 LABELS slow
      TIMEOUT 600)
  endforeach()
  add_test(NAME install:processors COMMAND /usr/bin/python3 ${here}/wheel_test.py ${CMAKE_BINARY_DIR}
    ${CMAKE_SOURCE_DIR} ${installed}/prefix ${CMAKE_CURRENT_BINARY_DIR}/packed_none Processors)
  set_tests_properties(install:processors PROPERTIES SKIP_RETURN_CODE 77)
  add_test(NAME install:packages COMMAND /usr/bin/python3 ${here}/packages_test.py ${CMAKE_BINARY_DIR}
    ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/packages)
  set_tests_properties(install:packages PROPERTIES SKIP_RETURN_CODE 77 LABELS "packages;slow" TIMEOUT 600)
  add_test(NAME install:debian_tree COMMAND /usr/bin/python3 ${here}/debian_tree_test.py ${CMAKE_BINARY_DIR}
    ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/debian)
  set_tests_properties(install:debian_tree PROPERTIES SKIP_RETURN_CODE 77 LABELS long TIMEOUT 7200)
  if(RAILSTRATA_VARIANTS)
    add_test(NAME install:Variants COMMAND ${install_test} Variants)
    add_test(NAME install:compare_variants COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tools/compare_variants.py
      ${installed}/prefix --native $<TARGET_FILE:railstrata> --rounds 1 --set run.preload_tolerance=1e-10)
    set_tests_properties(install:Variants install:compare_variants PROPERTIES FIXTURES_REQUIRED installed)
    set_tests_properties(install:compare_variants PROPERTIES LABELS long TIMEOUT 86400)
  endif()
endif()
add_test(NAME versions COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/install/versions_test.py
  $<TARGET_FILE:railstrata> ${CMAKE_SOURCE_DIR})
add_test(NAME front_door COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/install/front_door_test.py
  ${CMAKE_SOURCE_DIR})
add_test(NAME install:optional_parts COMMAND /usr/bin/python3
  ${CMAKE_SOURCE_DIR}/tests/install/optional_parts_test.py ${CMAKE_SOURCE_DIR})
