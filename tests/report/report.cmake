# Results of a small layered rolling and of its half-space solution, then what is made of them: the page in a browser,
# the picture by VTK.
set(results ${CMAKE_CURRENT_BINARY_DIR}/report_results)
set(here ${CMAKE_SOURCE_DIR}/tests/report)
set(railstrata $<TARGET_FILE:railstrata>)
railstrata_python_test(report:results ${here}/make_results.py ${railstrata} ${results})
railstrata_python_test(report:page SLOW ${here}/page_test.py ${railstrata} ${results})
railstrata_python_test(report:passes_page ${here}/passes_page_test.py ${railstrata} ${CMAKE_SOURCE_DIR})
railstrata_python_test(report:view SLOW ${here}/view_test.py ${results})
railstrata_python_test(report:bundle ${here}/bundle_test.py ${CMAKE_SOURCE_DIR}/web)
railstrata_python_test(report:what_if ${here}/what_if_page_test.py ${railstrata} ${results})
set_tests_properties(report:what_if report:view report:passes_page PROPERTIES LABELS slow)
set_tests_properties(report:results PROPERTIES FIXTURES_SETUP report_results COST 60)
set_tests_properties(report:page PROPERTIES COST 40)
set_tests_properties(report:page report:page_slow report:view report:view_slow report:what_if PROPERTIES
  FIXTURES_REQUIRED report_results)
