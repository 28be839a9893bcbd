# SPDX-License-Identifier: MIT
# Usage: cmake -D NM=nm -D OBJCOPY=objcopy -D LIBRARY=lib.a -D SUFFIX=.name -P own_symbols.cmake
# Gives every symbol of a static library that a linker would merge with one of the same name, above
# all the inline functions and templates of Eigen, a name of the library's own:
# docs/decisions/0010-own-symbols.md.
cmake_minimum_required(VERSION 3.25)

# NAME TYPE ...: weak functions and data (W, V), unique data (u), and what names a group of a
# constructor's or destructor's variants, by which linkers merge them (n).
execute_process(COMMAND "${NM}" --defined-only --format=posix "${LIBRARY}"
                OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
# A whole name: counters of coverage have the names of functions within theirs.
string(REGEX MATCHALL "\n_Z[^\n ]+ [WVun] " names "\n${symbols}")
list(TRANSFORM names REPLACE "\n([^ ]+) .*" "\\1")
list(REMOVE_DUPLICATES names)
# Type descriptions are compared across the program when an exception is caught. What is private to
# the library has no other copy, and the tests call it.
list(FILTER names EXCLUDE REGEX "^_ZT|^_ZNK?8tangency2v0(5exact|6detail)|\\${SUFFIX}$")
list(TRANSFORM names REPLACE "(.+)" "\\1 \\1${SUFFIX}")
list(JOIN names "\n" names)
file(WRITE "${LIBRARY}.symbols" "${names}\n")
execute_process(COMMAND "${OBJCOPY}" "--redefine-syms=${LIBRARY}.symbols" "${LIBRARY}"
                COMMAND_ERROR_IS_FATAL ANY)
