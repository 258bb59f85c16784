# The example in the README is examples/quick_start.cpp, letter by letter.
file(READ ${source}/README.md readme)
file(READ ${source}/examples/quick_start.cpp example)
string(STRIP "${example}" example)
string(FIND "${readme}" "```cpp\n${example}\n```" at)
if(at EQUAL -1)
  message(FATAL_ERROR "README.md does not show examples/quick_start.cpp as it is")
endif()
