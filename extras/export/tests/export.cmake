# Exported folders: CalculiX runs a deck, Octave reads results; the rest is held against the formats.
set(export_test /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/export_test.py $<TARGET_FILE:railstrata>
  ${CMAKE_SOURCE_DIR})
foreach(group Calculix Dyna Contact Refusals Octave)
  add_test(NAME export:${group} COMMAND ${export_test} ${group})
  set_tests_properties(export:${group} PROPERTIES LABELS extras SKIP_RETURN_CODE 77 TIMEOUT 600)
endforeach()
set_tests_properties(export:Calculix PROPERTIES LABELS "extras;slow")
