# Blocks of code of README.md, docs/ and the Python package's docstrings, as they are printed.
if(RAILSTRATA_LIBRARY)
  set(first_pages README.md docs/python.md python/railstrata/__init__.py python/railstrata/case.py)
  set(blocks_test /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/blocks_test.py ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}
    $<TARGET_FILE:railstrata>)
  add_test(NAME docs:first_pages COMMAND ${blocks_test} ${CMAKE_CURRENT_BINARY_DIR}/docs/first ${first_pages})
  add_test(NAME docs:blocks COMMAND ${blocks_test} ${CMAKE_CURRENT_BINARY_DIR}/docs/all --all-but ${first_pages})
  set_tests_properties(docs:first_pages docs:blocks PROPERTIES TIMEOUT 900)
  set_tests_properties(docs:first_pages docs:blocks PROPERTIES LABELS slow)
endif()
