# src/LAYERS as lists: WING_FOLDERS, from which #include "bem/solve_bem.hpp" starts; FLOORS, lowest first, the rooms of
# each joined by spaces; WING_OF_<room>.
file(STRINGS ${CMAKE_SOURCE_DIR}/src/LAYERS lines REGEX "^[a-z]")
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([a-z]+): *(.*)$" line "${line}")
  set(wing ${CMAKE_MATCH_1})
  list(APPEND WING_FOLDERS ${CMAKE_SOURCE_DIR}/src/${wing})
  string(REGEX REPLACE " *< *" ";" floors "${CMAKE_MATCH_2}")
  list(APPEND FLOORS ${floors})
  string(REPLACE " " ";" names "${floors}")
  foreach(name IN LISTS names)
    set(WING_OF_${name} ${wing})
  endforeach()
endforeach()
