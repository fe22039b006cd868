# Debian packages: `cpack --config build/release/CPackConfig.cmake`, after a build. docs/install.md
# describes them; `sh tests/packages.sh` builds, examines, installs and removes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME claystack)
set(CPACK_PACKAGE_VENDOR "${CLAYSTACK_DEVELOPERS}")
set(CPACK_PACKAGE_CONTACT "${CLAYSTACK_DEVELOPERS} <${CLAYSTACK_CONTACT}>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL dev)
if(CLAYSTACK_APP)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(CLAYSTACK_STUDIO)
  list(APPEND CPACK_COMPONENTS_ALL studio)
endif()
if(CLAYSTACK_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME claystack)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "throw pots on a virtual wheel and export files that print
 Claystack throws a pot from a recorded session, from strokes or by hand with
 a haptic arm, and exports it as a solid that is proved closed: 3MF, STL, OBJ,
 PLY, GLB, Draco or STEP. It also imports drawings, checks and repairs any
 mesh, and draws pictures without a screen.")
# The libraries of OpenGL are opened at run time, where dpkg-shlibdeps cannot see them.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libgl1, libgl1-mesa-dri")
# The pages link to the headers and example programs.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "claystack-studio, libclaystack-dev")

set(CPACK_DEBIAN_STUDIO_PACKAGE_NAME claystack-studio)
set(CPACK_DEBIAN_STUDIO_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_STUDIO_DESCRIPTION "window of Claystack, the virtual potter's wheel
 Throw pots with the mouse or a haptic arm, with undo, branches, recovery,
 wall thickness on screen and export. Pots open by a double click and show as
 thumbnails in the file manager.")
set(CPACK_DEBIAN_STUDIO_PACKAGE_DEPENDS
  "claystack (= ${PROJECT_VERSION}), fonts-dejavu-core, libegl1, libgl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_STUDIO_PACKAGE_RECOMMENDS "zenity | kdialog")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libclaystack-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "libraries of Claystack, the virtual potter's wheel
 Static libraries, headers, CMake and pkg-config files: the clay, its files,
 certified solids, mesh formats, and the servo of haptic arms.")
set(dev_depends libglm-dev libexpected-dev)
if(CLAYSTACK_FILES)
  list(APPEND dev_depends nlohmann-json3-dev)
endif()
if(CLAYSTACK_EXPORT)
  list(APPEND dev_depends libcgal-dev libzip-dev libxml2-dev libcairo2-dev libxxhash-dev)
endif()
if(CLAYSTACK_DRACO)
  list(APPEND dev_depends libdraco-dev)
endif()
if(CLAYSTACK_EXPORT AND CLAYSTACK_OPENMESH)
  list(APPEND dev_depends libopenmesh-dev)
endif()
if(CLAYSTACK_MESHOPT)
  list(APPEND dev_depends libmeshoptimizer-dev)
endif()
if(CLAYSTACK_USB)
  list(APPEND dev_depends libftdi1-dev libusb-1.0-0-dev libhidapi-dev)
endif()
if(TARGET claystack_servo)
  list(APPEND dev_depends libfmt-dev)
endif()
list(JOIN dev_depends ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)

if(CLAYSTACK_PYTHON)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-claystack)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Claystack, the virtual potter's wheel, from Python
 Throw, export, check and import pots; meshes and rings as NumPy arrays that
 show the memory of the library without a copy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
  # Python leaves compiled files, which dpkg does not know.
  set(scripts ${PROJECT_BINARY_DIR}/package/python)
  file(WRITE ${scripts}/postinst "#!/bin/sh\nset -e\nif command -v py3compile >/dev/null; then\n"
    "  py3compile -p python3-claystack\nfi\n")
  file(WRITE ${scripts}/prerm "#!/bin/sh\nset -e\nif command -v py3clean >/dev/null; then\n"
    "  py3clean -p python3-claystack\nfi\n")
  file(CHMOD ${scripts}/postinst ${scripts}/prerm PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm)
endif()

# Each package has its own copyright and changelog, as Debian's policy requires.
set(package_docs ${PROJECT_BINARY_DIR}/package)
configure_file(cmake/copyright.in ${package_docs}/copyright @ONLY)
# The time of the last commit, so that every build of it has the same changelog.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%ct
    OUTPUT_VARIABLE commit_time OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_commit)
  if(NOT no_commit)
    set(ENV{SOURCE_DATE_EPOCH} ${commit_time})
  endif()
endif()
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/changelog.in ${package_docs}/changelog @ONLY)
execute_process(COMMAND gzip -9nkf ${package_docs}/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES ${package_docs}/copyright ${package_docs}/changelog.gz COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()

include(CPack)
