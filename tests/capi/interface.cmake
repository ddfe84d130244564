# Members of states and forces: lists of the library, C header, Fortran module and Python package.
railstrata_python_test(capi:interface ${CMAKE_SOURCE_DIR}/tests/capi/interface_test.py ${CMAKE_SOURCE_DIR})
