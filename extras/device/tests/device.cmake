# Tests that need a card: a program of their own, under the label gpu; without a card they are skipped and say why.
add_executable(test_card ${CMAKE_CURRENT_LIST_DIR}/card/card_test.cpp)
target_link_libraries(test_card PRIVATE room_device GTest::gtest_main)
target_include_directories(test_card PRIVATE ${CMAKE_SOURCE_DIR})
railstrata_gtest(test_card device: extras gpu)
add_executable(measure_card ${CMAKE_CURRENT_LIST_DIR}/card/measure.cpp)
target_link_libraries(measure_card PRIVATE room_device)

# Every .cu compiles and spills nothing; needs nvcc and no card.
add_test(NAME device:kernels_compile_without_spills COMMAND /usr/bin/python3
  ${CMAKE_CURRENT_LIST_DIR}/card/spills_test.py ${CMAKE_SOURCE_DIR} "${RAILSTRATA_NVCC}" ${CMAKE_CXX_COMPILER})
set_tests_properties(device:kernels_compile_without_spills PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900 LABELS "extras;slow")

# run.device without a card, and on the emulated one.
railstrata_python_test(device:option ${CMAKE_CURRENT_LIST_DIR}/device_test.py $<TARGET_FILE:railstrata>)
set_tests_properties(device:option PROPERTIES LABELS "extras;slow")
