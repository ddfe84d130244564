# bem, compare, creep-curve and sweep from outside: messages, exit codes, files.
add_test(NAME app:bem_commands COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tests/app/bem_commands_test.py $<TARGET_FILE:railstrata> ${CMAKE_SOURCE_DIR})
