# The README shows the example, both files, to the letter.
include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)

file(READ ${SOURCE}/README.md readme)
foreach(language_and_file "cpp:main.cpp" "cmake:CMakeLists.txt")
  string(REGEX MATCH "^([a-z]+):(.+)$" _ ${language_and_file})
  set(language ${CMAKE_MATCH_1})
  set(file ${CMAKE_MATCH_2})
  file(READ ${SOURCE}/tests/package/example/${file} example)
  string(FIND "${readme}" "```${language}\n${example}```\n" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "Expected: README.md shows tests/package/example/${file} as it is")
  endif()
endforeach()
