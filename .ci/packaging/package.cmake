# SPDX-License-Identifier: MIT
# What the libraries of this project have in common, and the package that is made of them:
# docs/decisions/0015-package.md.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include("${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake")
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/tangency")

# tangency_require(NAME ...): libraries of dependencies.cmake, or the end with a line that says what to install.
macro(tangency_require)
  tangency_find(tangency_missing ${ARGN})
  if(tangency_missing)
    message(FATAL_ERROR "Tangency: ${tangency_missing}")
  endif()
endmacro()

# tangency_hide_places(): what this folder and those below it build holds no path of where it was built, in
# asserts and for debuggers, since it is installed elsewhere.
function(tangency_hide_places)
  if(TANGENCY_INSTALL)
    add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}=."
                        "-ffile-prefix-map=${PROJECT_BINARY_DIR}=./build"
                        "-ffile-prefix-map=${include_tangency}=.")
  endif()
endfunction()

# tangency_library(TARGET COMPONENT FOLDER HEADER ...): a library of the package, with its public headers.
function(tangency_library target component folder)
  target_compile_features(${target} PUBLIC cxx_std_20)
  list(TRANSFORM ARGN PREPEND "${include_tangency}/${folder}/" OUTPUT_VARIABLE headers)
  set_property(GLOBAL APPEND PROPERTY tangency_public_headers ${headers})
  target_sources(${target} PUBLIC
    FILE_SET HEADERS BASE_DIRS "${PROJECT_BINARY_DIR}/include" FILES ${headers})
  # A part of anybody's shared library. Calls within the library go to the library's own functions:
  # exported.map and -Bsymbolic-functions see to it, and g++ may inline them.
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON DEFINE_SYMBOL "")
  # What it becomes a part of shows nothing of it, and takes its own functions, not those of another copy.
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
  # Why: docs/decisions/0015-package.md.
  if(TANGENCY_OPTIMIZED_KERNEL)
    target_compile_options(${target} PRIVATE $<$<OR:$<CONFIG:>,$<CONFIG:Debug>>:-O2>)
  endif()
  tangency_install_library(${target} ${component})
endfunction()

# tangency_install_library(TARGET COMPONENT): tangency::NAME for tangency_NAME, built and installed. What
# a program needs to run is in the component COMPONENT-runtime, if it is a shared library.
function(tangency_install_library target component)
  string(REPLACE "tangency_" "" name ${target})
  if(NOT TARGET tangency::${name})
    add_library(tangency::${name} ALIAS ${target})
  endif()
  set_property(GLOBAL APPEND PROPERTY tangency_components ${component})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  get_target_property(type ${target} TYPE)
  set(headers "")
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    set(headers FILE_SET HEADERS COMPONENT ${component})
    # Before 1.0 a minor version may break programs that run with another.
    set_target_properties(${target} PROPERTIES
      VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
      INSTALL_RPATH "$ORIGIN")
  endif()
  if(TANGENCY_INSTALL)
    install(TARGETS ${target} EXPORT tangency_${component}
      INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
      LIBRARY COMPONENT ${component}-runtime NAMELINK_COMPONENT ${component}
      ARCHIVE COMPONENT ${component} RUNTIME COMPONENT ${component}-runtime
      ${headers})
  endif()
endfunction()

function(tangency_install_tool target)
  if(TANGENCY_INSTALL)
    cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR
               BASE_DIRECTORY "${CMAKE_INSTALL_FULL_BINDIR}" OUTPUT_VARIABLE libraries)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
    install(TARGETS ${target} RUNTIME COMPONENT tools)
    tangency_install_descriptions(${target})
  endif()
endfunction()

# What a tool says of its own command line (geometry/tables/command_text.hpp): its manual page, and the
# completions of two shells.
function(tangency_install_descriptions target)
  if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    return()
  endif()
  get_target_property(name ${target} OUTPUT_NAME)
  # A command that is a target, not its file, is run by the emulator of a cross build.
  set(dir "${CMAKE_CURRENT_BINARY_DIR}/described")
  set(commands "")
  foreach(form man:${name}.1 bash:${name} zsh:_${name})
    string(REPLACE ":" ";" form ${form})
    list(GET form 0 shell)
    list(GET form 1 file)
    list(APPEND commands COMMAND ${target} --describe ${shell} > "${dir}/${shell}/${file}")
    file(MAKE_DIRECTORY "${dir}/${shell}")
  endforeach()
  add_custom_command(TARGET ${target} POST_BUILD ${commands})
  install(DIRECTORY "${dir}/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tools)
  install(DIRECTORY "${dir}/bash/" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
          COMPONENT tools)
  set(functions site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(functions vendor-completions)  # where Debian's zsh looks for those of packages
  endif()
  install(DIRECTORY "${dir}/zsh/" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/${functions}" COMPONENT tools)
endfunction()

# tangency_pkg_config(COMPONENT DESCRIPTION REQUIRES PRIVATE [LIBRARY ...]): the file tangency-COMPONENT.pc.
# Who links a static library needs what is private to it, packages and libraries (from C and Fortran those
# of C++ too, behind the objects that ask for them), and is not to know of which kind it is.
function(tangency_pkg_config component description requires private)
  get_target_property(type tangency_${component} TYPE)
  set(libraries "-L\${libdir} -ltangency_${component}")
  if(type STREQUAL "STATIC_LIBRARY")
    list(APPEND requires ${private})
    list(JOIN ARGN " " others)
    string(APPEND libraries " ${others} -pthread")
  endif()
  list(JOIN requires ", " requires)
  set(pkg_config_dir "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig")
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY "${pkg_config_dir}"
             OUTPUT_VARIABLE libdir)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR BASE_DIRECTORY "${pkg_config_dir}"
             OUTPUT_VARIABLE includedir)
  configure_file(.ci/packaging/tangency.pc.in tangency-${component}.pc @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/tangency-${component}.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT ${component})
endfunction()

# What is installed beside the libraries, once all of them are known.
function(tangency_install_package)
  if(NOT TANGENCY_INSTALL)
    return()
  endif()
  set(documents "${CMAKE_INSTALL_DATAROOTDIR}/doc/tangency")  # also within another project
  if(NOT TARGET tangency_geometry)  # the grader alone: no library, so no package to find
    install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${documents}" COMPONENT tools)
    install(DIRECTORY LICENSES DESTINATION "${documents}" COMPONENT tools)
    return()
  endif()
  get_property(components GLOBAL PROPERTY tangency_components)
  list(REMOVE_DUPLICATES components)
  foreach(component IN LISTS components)
    install(EXPORT tangency_${component} FILE tangency-${component}.cmake NAMESPACE tangency::
            DESTINATION "${package_dir}" COMPONENT ${component})
  endforeach()
  get_target_property(tangency_type tangency_geometry TYPE)
  configure_package_config_file(.ci/packaging/tangencyConfig.cmake.in tangencyConfig.cmake
                                INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(tangencyConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/tangencyConfig.cmake"
                "${PROJECT_BINARY_DIR}/tangencyConfigVersion.cmake" .ci/packaging/dependencies.cmake
          DESTINATION "${package_dir}" COMPONENT geometry)

  tangency_pkg_config(geometry "How two ellipsoids touch, exactly (C++20)" "eigen3 >= 3.4" "gmpxx;libhwy" -lstdc++ -lm)
  if(TARGET tangency_dem)
    tangency_pkg_config(micromechanics "Fabric and stress of any contacts (C++20)" "eigen3 >= 3.4" qhull_r)
    tangency_pkg_config(dem "Assemblies of ellipsoids in a periodic cell (C++20)"
                        "tangency-geometry = ${PROJECT_VERSION}" "tbb;tomlplusplus;libhwy")
  endif()

  if(TARGET tangency_c)
    tangency_pkg_config(c "How two ellipsoids touch, exactly (C89)" "" "tangency-geometry = ${PROJECT_VERSION}")
  endif()

  if(PROJECT_IS_TOP_LEVEL)  # CPack has one project: elsewhere it is that of the user
    include(.ci/packaging/debian.cmake)
  endif()
  install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${documents}" COMPONENT geometry)
  install(DIRECTORY LICENSES docs/example DESTINATION "${documents}" COMPONENT geometry)
endfunction()
