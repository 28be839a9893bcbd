# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -D OUTPUT=FILE "-D SOURCES=FILE;..." -P together.cmake: one source made of several tests, so
# that the templates of googletest, Eigen and the standard library are instantiated once for all of
# them: docs/build-time.md. Each test keeps its lines in messages, and gets a namespace of its own,
# named after its file: equal names in two tests stay two things, as in separate objects.
cmake_minimum_required(VERSION 3.25)
set(whole "")
foreach(source IN LISTS SOURCES)
  get_filename_component(name "${source}" NAME_WE)
  file(READ "${source}" text)
  if(text MATCHES "\n#define ")
    message(FATAL_ERROR "${source}: a macro would reach the tests after it: add it to ALONE")
  elseif(text MATCHES "\nnamespace tangency[a-z_:]* {\n")
    string(REGEX REPLACE "\nnamespace tangency([a-z_:]*) {\n" "\nnamespace tangency\\1::${name} {\n"
           text "${text}")
  else()
    # The line after the last #include is empty.
    string(REGEX REPLACE "^(.*\n#include [^\n]*\n)\n" "\\1namespace ${name} {\n" text "${text}")
    string(APPEND text "}  // namespace ${name}\n")
  endif()
  string(FIND "${text}" "::${name} {\n" within)
  string(FIND "${text}" "\nnamespace ${name} {\n" around)
  if(within EQUAL -1 AND around EQUAL -1)
    message(FATAL_ERROR "${source}: an empty line has to follow the last #include")
  endif()
  string(APPEND whole "#line 1 \"${source}\"\n${text}")
endforeach()
file(WRITE "${OUTPUT}" "${whole}")
