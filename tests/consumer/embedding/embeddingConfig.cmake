# SPDX-License-Identifier: GPL-3.0-or-later
include(CMakeFindDependencyMacro)
find_dependency(tangency COMPONENTS geometry)
include("${CMAKE_CURRENT_LIST_DIR}/embeddingTargets.cmake")
