# What `cmake --install` puts under a prefix, by component:
#   runtime      the program, its helper polycube-tet, the Python module, FreeCAD's workbench, the manual page; what the .deb has
#   development  the library and headers for C++, found by find_package(Polycube)
# It installs what was built: ninja builds polycube, polycube-tet, _polycube, polycube_shared and manual, and all of them by itself.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
# An unwanted default would hold the development component.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)

install(TARGETS polycube RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS polycube-tet RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/polycube)

# Debian's Python looks in lib/python3 of /usr and in lib/python3.11 of /usr/local. The prefix is known when it is installed.
if(POLYCUBE_PYTHON)
  install(CODE "
    if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\" AND EXISTS /etc/debian_version)
      set(folder lib/python3/dist-packages)
    elseif(EXISTS /etc/debian_version)
      set(folder lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages)
    else()
      set(folder lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages)
    endif()
    file(INSTALL \"$<TARGET_FILE:_polycube>\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/\${folder}\" TYPE SHARED_LIBRARY)
    if(CMAKE_INSTALL_DO_STRIP)
      execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-unneeded \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/\${folder}/$<TARGET_FILE_NAME:_polycube>\")
    endif()
  " COMPONENT runtime)
endif()

# /usr/lib/freecad/Mod is a link to this folder on Debian; a package must not make a folder in the link's place.
set(MOD ${CMAKE_INSTALL_DATADIR}/freecad/Mod/Polycube)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/Mod/Polycube/ DESTINATION ${MOD}
  PATTERN "*.so" EXCLUDE PATTERN "__pycache__" EXCLUDE PATTERN "LICENSE" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${MOD})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/resources/icons ${PROJECT_SOURCE_DIR}/resources/ui ${PROJECT_SOURCE_DIR}/resources/translations
  DESTINATION ${MOD}/freecad/polycube/resources PATTERN "*.py" EXCLUDE PATTERN "__pycache__" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

# The manual page comes from what the program says of itself.
set(MANUAL ${PROJECT_BINARY_DIR}/polycube.1.gz)
add_custom_command(OUTPUT ${MANUAL} VERBATIM
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/manual.py $<TARGET_FILE:polycube> ${MANUAL}
  DEPENDS polycube ${CMAKE_CURRENT_LIST_DIR}/manual.py ${CMAKE_CURRENT_LIST_DIR}/polycube.1.in)
add_custom_target(manual ALL DEPENDS ${MANUAL})
install(FILES ${MANUAL} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

# All stages as one library: whoever links it needs none of what they link, and it finds polycube-tet from where it lies.
set(STAGES core cad tet label deform blocks quantize hex pad fit fem pipeline)
list(TRANSFORM STAGES REPLACE "(.+)" "$<TARGET_OBJECTS:polycube_\\1>" OUTPUT_VARIABLE STAGE_OBJECTS)
list(TRANSFORM STAGES PREPEND polycube_ OUTPUT_VARIABLE STAGE_LIBRARIES)
add_library(polycube_shared SHARED ${STAGE_OBJECTS})
target_link_libraries(polycube_shared PUBLIC Eigen3::Eigen PRIVATE ${STAGE_LIBRARIES})
target_include_directories(polycube_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/polycube>)
target_compile_features(polycube_shared INTERFACE cxx_std_20)
set_target_properties(polycube_shared PROPERTIES OUTPUT_NAME polycube EXPORT_NAME polycube LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS polycube_shared EXPORT PolycubeTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development NAMELINK_COMPONENT development)

# polycube_with_includes(HEADER): adds it, and what it includes of ours, to HEADERS.
function(polycube_with_includes HEADER)
  if(HEADER IN_LIST HEADERS)
    return()
  endif()
  list(APPEND HEADERS ${HEADER})
  file(STRINGS ${PROJECT_SOURCE_DIR}/backend/${HEADER} LINES REGEX "^#include \"")
  foreach(LINE ${LINES})
    string(REGEX REPLACE "#include \"(.*)\"" "\\1" INCLUDED ${LINE})
    polycube_with_includes(${INCLUDED})
  endforeach()
  set(HEADERS ${HEADERS} PARENT_SCOPE)
endfunction()

set(HEADERS)
file(GLOB CORE_HEADERS RELATIVE ${PROJECT_SOURCE_DIR}/backend ${PROJECT_SOURCE_DIR}/backend/core/*.h)
foreach(HEADER ${CORE_HEADERS} pipeline/part_mesh.h pipeline/pipeline.h pipeline/label_part.h pipeline/inspect.h pipeline/hex_map.h)
  polycube_with_includes(${HEADER})
endforeach()
foreach(HEADER ${HEADERS})
  get_filename_component(FOLDER ${HEADER} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/backend/${HEADER} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/polycube/${FOLDER} COMPONENT development)
endforeach()

set(CONFIG ${CMAKE_INSTALL_LIBDIR}/cmake/Polycube)
install(EXPORT PolycubeTargets NAMESPACE Polycube:: DESTINATION ${CONFIG} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/PolycubeConfig.cmake.in ${PROJECT_BINARY_DIR}/PolycubeConfig.cmake INSTALL_DESTINATION ${CONFIG})
# Names and meanings may change with the second number as long as the first is 0.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PolycubeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PolycubeConfig.cmake ${PROJECT_BINARY_DIR}/PolycubeConfigVersion.cmake DESTINATION ${CONFIG} COMPONENT development)

include(${CMAKE_CURRENT_LIST_DIR}/package.cmake)
