# A vehicle of another code with the contact of this library (examples/orvd), where its sources are.
set(RAILSTRATA_ORVD "" CACHE PATH "A checkout of github.com/wenquantongxin/OpenRailVehicleDynamics, for capi:orvd")
if(RAILSTRATA_LIBRARY)
  railstrata_python_test(capi:orvd ${CMAKE_SOURCE_DIR}/tests/capi/orvd_test.py $<TARGET_FILE:railstrata_library${installed_suffix}>
    ${CMAKE_SOURCE_DIR}/examples/orvd ${RAILSTRATA_ORVD})
  set_tests_properties(capi:orvd PROPERTIES LABELS long TIMEOUT 7200)
endif()
