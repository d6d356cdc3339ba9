# cmake -D SOURCES=DIR -D OUT=FILE -P replay_template.cmake
#
# The page that replay.html is made from, as a string in C++: page.html, with the styles and scripts that it
# names as <!-- style FILE --> and <!-- script FILE --> in their place, so that it is one file, and the licences
# of others' as <!-- licence FILE -->.
file(READ ${SOURCES}/page.html page)
foreach(kind style script licence)
  string(REGEX MATCHALL "<!-- ${kind} [a-zA-Z_/.]+ -->" places "${page}")
  foreach(place IN LISTS places)
    string(REGEX REPLACE "<!-- ${kind} (.*) -->" "\\1" name "${place}")
    file(READ ${SOURCES}/${name} content)
    if(kind STREQUAL "licence")
      string(REPLACE "${place}" "<!--\n${content}-->" page "${page}")
    else()
      string(REPLACE "${place}" "<${kind}>\n${content}</${kind}>" page "${page}")
    endif()
  endforeach()
endforeach()
file(WRITE ${OUT} "// Made by cmake/replay_template.cmake.\n#pragma once\n#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n\ninline constexpr char kReplayTemplate[] = R\"__page__(${page})__page__\";\n")
