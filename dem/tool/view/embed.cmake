# SPDX-License-Identifier: MIT
# cmake -D OUTPUT=FILE "-D STYLE=FILE" "-D SCRIPTS=FILE;..." -P embed.cmake: a source that holds what a report's
# page is given to show the sample with, byte for byte: dem/tool/view/sample_view.hpp.
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
    message(FATAL_ERROR "${mark} must not stand in a file of dem/tool/view")
  endif()
endforeach()
file(WRITE "${OUTPUT}" "#include <tangency/dem/tool/view/sample_view.hpp>

namespace tangency::inline v0::dem {

std::string_view view_style() { return R\"view(${style})view\"; }
std::string_view view_script() { return R\"view(${script})view\"; }

}  // namespace tangency::inline v0::dem
")
