# Results of a small layered rolling and of its half-space solution, then what is made of them: the page in a browser, the picture by VTK.
set(results ${CMAKE_CURRENT_BINARY_DIR}/report_results)
set(here ${CMAKE_SOURCE_DIR}/tests/report)
add_test(NAME report:results COMMAND /usr/bin/python3 ${here}/make_results.py $<TARGET_FILE:railstrata> ${results})
add_test(NAME report:page COMMAND /usr/bin/python3 ${here}/page_test.py $<TARGET_FILE:railstrata> ${results})
add_test(NAME report:view COMMAND /usr/bin/python3 ${here}/view_test.py ${results})
add_test(NAME report:bundle COMMAND /usr/bin/python3 ${here}/bundle_test.py ${CMAKE_SOURCE_DIR}/report)
set_tests_properties(report:results PROPERTIES FIXTURES_SETUP report_results)
set_tests_properties(report:page report:view PROPERTIES FIXTURES_REQUIRED report_results SKIP_RETURN_CODE 77)
