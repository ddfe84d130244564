# kiss, which the explorer's engine takes, is tested whatever the build takes.
if(NOT RAILSTRATA_FFT STREQUAL "kiss")
  set(room ${CMAKE_SOURCE_DIR}/src/laws/fft)
  add_executable(test_fft_kiss ${CMAKE_CURRENT_SOURCE_DIR}/fft/fft_test.cpp ${room}/fft_kiss.cpp ${room}/fft_lengths.cpp)
  target_link_libraries(test_fft_kiss PRIVATE railstrata_flags Eigen3::Eigen GTest::gtest_main)
  railstrata_gtest(test_fft_kiss fft:kiss:)
endif()
