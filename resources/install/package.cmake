# The Debian package, made by `sh resources/polycube package`: the component runtime under /usr.
file(STRINGS ${PROJECT_SOURCE_DIR}/Mod/Polycube/package.xml MAINTAINER REGEX "<maintainer ")
string(REGEX REPLACE ".*email=\"([^\"]*)\">([^<]*)<.*" "\\2 <\\1>" MAINTAINER "${MAINTAINER}")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME polycube)
set(CPACK_PACKAGE_CONTACT "${MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL runtime)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "hexahedral finite element meshes of CAD solids, by polycube maps
The program polycube meshes STEP, IGES, BREP and FreeCAD files for CalculiX and
others; the Python module _polycube and the workbench for FreeCAD do so too.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The module is for one version of Python.
math(EXPR NEXT_PYTHON "${Python3_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${NEXT_PYTHON}), python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS freecad)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS calculix-ccx)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
