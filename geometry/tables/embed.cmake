# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=FILE "-D STYLE=FILE" "-D SCRIPTS=FILE;..." -D HEADER=FILE -D NAMESPACE=NAME -P embed.cmake: a source
# that holds what a page is given to draw with, byte for byte. HEADER declares view_style() and view_script() in
# tangency::NAMESPACE.
cmake_minimum_required(VERSION 3.25)
file(READ "${STYLE}" style)
set(script "")
foreach(file IN LISTS SCRIPTS)
  file(READ "${file}" text)
  string(APPEND script "${text}")
endforeach()
foreach(mark ")view\"" "</script" "</style")
  string(FIND "${style}${script}" "${mark}" place)
  if(NOT place EQUAL -1)
    message(FATAL_ERROR "${mark} must not stand in a file that a page is given")
  endif()
endforeach()
file(WRITE "${OUTPUT}" "#include <${HEADER}>

namespace tangency::inline v0::${NAMESPACE} {

std::string_view view_style() { return R\"view(${style})view\"; }
std::string_view view_script() { return R\"view(${script})view\"; }

}  // namespace tangency::inline v0::${NAMESPACE}
")
