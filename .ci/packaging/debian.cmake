# SPDX-License-Identifier: MIT
# The Debian packages: cmake --preset debian && cmake --build --preset debian && cpack --preset debian.
# A table of them: the package, what it says of itself, the install components in it, what it needs
# beyond the libraries of other projects that it is linked with, and where it stands in an archive.
set(version_of_libraries ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(debian_packages geometry dem dev verify tools python)
set(same "(= ${PROJECT_VERSION})")

set(debian_geometry_name "libtangency-geometry${version_of_libraries}")
set(debian_geometry_summary "how two ellipsoids touch, exactly")
set(debian_geometry_components geometry-runtime c-runtime)
set(debian_geometry_section libs)

set(debian_dem_name "libtangency-dem${version_of_libraries}")
set(debian_dem_summary "assemblies of ellipsoids by the discrete element method")
set(debian_dem_components micromechanics-runtime dem-runtime)
set(debian_dem_needs "${debian_geometry_name} ${same}")
set(debian_dem_section libs)

set(debian_dev_name "libtangency-dev")
set(debian_dev_summary "how two ellipsoids touch, exactly: headers, CMake package, pkg-config")
set(debian_dev_components geometry micromechanics dem c fortran)
set(debian_dev_needs "${debian_geometry_name} ${same}, ${debian_dem_name} ${same}, libeigen3-dev (>= 3.4)")
set(debian_dev_section libdevel)

set(debian_verify_name "libtangency-verify-dev")
set(debian_verify_summary "oracles for contact between ellipsoids (GPL)")
set(debian_verify_components verify)
set(debian_verify_needs "libtangency-dev ${same}, libboost-dev, libgsl-dev, libgmp-dev, libmpfr-dev")
set(debian_verify_section libdevel)

set(debian_tools_name "tangency")
set(debian_tools_summary "contact, overlap and packings of ellipsoids on the command line")
set(debian_tools_components tools)
set(debian_tools_needs "${debian_geometry_name} ${same}, ${debian_dem_name} ${same}")
set(debian_tools_section science)

set(debian_python_name "python3-tangency")
set(debian_python_summary "how two ellipsoids touch, exactly: the Python package")
set(debian_python_components python)
set(debian_python_needs "python3, python3-numpy, ${debian_geometry_name} ${same}")
set(debian_python_section python)

# Who is to be asked about a package is who builds it. The project is named as in CITATION.cff; it has no
# address of its own (SECURITY.md), and this one, of a domain that is never given out, reaches nobody.
set(TANGENCY_MAINTAINER "The Tangency project <maintainer@tangency.example>" CACHE STRING
    "Maintainer of the Debian packages, NAME <ADDRESS>")
mark_as_advanced(TANGENCY_MAINTAINER)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tangency)
set(CPACK_PACKAGE_CONTACT "${TANGENCY_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

get_cmake_property(components_there COMPONENTS)
set(CPACK_COMPONENTS_ALL "")
foreach(package IN LISTS debian_packages)
  string(TOUPPER ${package} PACKAGE)
  set(CPACK_COMPONENT_GROUP_${PACKAGE}_DESCRIPTION "${debian_${package}_summary}")
  set(CPACK_DEBIAN_${PACKAGE}_PACKAGE_NAME ${debian_${package}_name})
  set(CPACK_DEBIAN_${PACKAGE}_PACKAGE_SECTION ${debian_${package}_section})
  set(CPACK_DEBIAN_${PACKAGE}_PACKAGE_DEPENDS "${debian_${package}_needs}")
  set(CPACK_DEBIAN_${PACKAGE}_DESCRIPTION "${debian_${package}_summary}")
  foreach(component IN LISTS debian_${package}_components)
    if(component IN_LIST components_there)
      string(TOUPPER ${component} COMPONENT)
      set(CPACK_COMPONENT_${COMPONENT}_GROUP ${package})
      list(APPEND CPACK_COMPONENTS_ALL ${component})
      if(NOT copyright_of_${package})
        set(copyright_of_${package} ${component})
      endif()
    endif()
  endforeach()
endforeach()
# Each package has its licence where Debian looks for it; in a prefix of another kind one copy is enough.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  foreach(package IN LISTS debian_packages)
    if(copyright_of_${package})
      install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/${debian_${package}_name}"
              RENAME copyright COMPONENT ${copyright_of_${package}})
    endif()
  endforeach()
endif()
# Where dpkg-shlibdeps finds the libraries of the other packages.
foreach(library geometry micromechanics dem c)
  if(TARGET tangency_${library})
    get_target_property(place tangency_${library} BINARY_DIR)
    list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${place}")
  endif()
endforeach()
include(CPack)
