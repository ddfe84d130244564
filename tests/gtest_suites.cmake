# ctest reads this when it starts, once for each GoogleTest program: a test for each suite, since a process for each of
# its tests costs more than most of them. The name is <prefix><suite>; what failed is named in the output, and
# `<program> --gtest_filter=Suite.Test` runs one alone. Suites whose name begins with Slow or Long get that label
# besides.
if(NOT EXISTS "${program}")
  add_test("${prefix}NOT_BUILT" "${program}")
  return()
endif()
execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${program} cannot list its tests: ${failed}")
endif()
string(REGEX MATCHALL "(^|\n)[^ \n]+\\." suites "${listed}")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n|\\.$" "" suite "${suite}")
  set(test "${prefix}${suite}")
  add_test("${test}" "${program}" "--gtest_filter=${suite}.*")
  set(kind "${labels}")
  if(suite MATCHES "(^|/)(Long|Slow)")
    string(TOLOWER "${CMAKE_MATCH_2}" size)
    list(APPEND kind ${size})
  endif()
  # threads that wait sleep (the program's do nearly so, src/doors/app/main.cpp): spinning, a test of a few seconds takes a
  # minute on shared cores
  set_tests_properties("${test}" PROPERTIES LABELS "${kind}" ENVIRONMENT OMP_WAIT_POLICY=passive
    SKIP_REGULAR_EXPRESSION "\\[  PASSED  \\] 0 tests\\.\n\\[  SKIPPED \\][^\n]*\n(\\[  SKIPPED \\][^\n]*\n)*$")
endforeach()
