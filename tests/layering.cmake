# cmake -DSOURCE=... -P layering.cmake: checks which room may include which. The compiler cannot
# check it: private headers share one include root, and CGAL, Draco and libusb share one system
# folder.

cmake_minimum_required(VERSION 3.25)

# A room may include the private headers of the rooms before it in its component, and of core.
set(rooms
  core core/json
  engine/clay engine/tool engine/tick engine/collapse engine/wheel engine/files
  export/section export/solid export/walls export/formats export/proof export/smoothing
  export/check export/repair export/fallen export/job
  falcon/device falcon/device/usb falcon/safety falcon/sim
  app/chart app/history app/strokes app/servo app/import app/render app/bench app/cli app/studio app/web app/python)
# A component may include the public headers of these.
set(core_uses core)
set(engine_uses core engine)
set(export_uses core engine export)
set(falcon_uses core falcon)
set(app_uses core engine export falcon servo)
# The benchmark times the stages of a tick individually.
set(exceptions "app/bench -> engine/clay" "app/bench -> engine/tool" "app/bench -> engine/tick")

# room_of(PATH OUT): the longest room that contains PATH; empty if there is none.
function(room_of path out)
  set(found "")
  foreach(room IN LISTS rooms)
    string(FIND "${path}" "${room}/" at)
    string(LENGTH "${room}" length)
    string(LENGTH "${found}" longest)
    if(at EQUAL 0 AND length GREATER longest)
      set(found ${room})
    endif()
  endforeach()
  set(${out} "${found}" PARENT_SCOPE)
endfunction()

function(check_private file room header)
  room_of(${header} target)
  if(target STREQUAL "")
    message(SEND_ERROR "${file}: ${header} lies in no room of tests/layering.cmake")
    return()
  endif()
  if("${room} -> ${target}" IN_LIST exceptions)
    return()
  endif()
  string(REGEX MATCH "^[a-z]+" component ${room})
  string(REGEX MATCH "^[a-z]+" target_component ${target})
  list(FIND rooms ${room} here)
  list(FIND rooms ${target} there)
  if(NOT target_component STREQUAL "core" AND NOT target_component STREQUAL component)
    message(SEND_ERROR "${file}: ${header} is private to ${target_component}")
  elseif(there GREATER here)
    message(SEND_ERROR "${file}: ${room} may not include ${target}, which comes after it")
  endif()
endfunction()

function(check_public file component header)
  if(header STREQUAL "claystack/version.hpp")
    return()
  endif()
  string(REGEX REPLACE "^claystack/([a-z]+)/.*$" "\\1" target ${header})
  if(NOT target IN_LIST ${component}_uses)
    message(SEND_ERROR "${file}: ${component} may not include ${header}")
  endif()
endfunction()

set(seen 0)
foreach(component core engine export falcon app)
  file(GLOB_RECURSE files RELATIVE ${SOURCE}
    ${SOURCE}/${component}/*.hpp ${SOURCE}/${component}/*.cpp)
  foreach(file IN LISTS files)
    room_of(${file} room)
    file(STRINGS ${SOURCE}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*\"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^[^\"]*\"([^\"]+)\".*$" "\\1" header "${line}")
      math(EXPR seen "${seen} + 1")
      if(header MATCHES "^claystack/")
        check_public(${file} ${component} ${header})
      elseif(header MATCHES "^(core|engine|export|falcon|app)/")
        if(file MATCHES "/include/claystack/")
          message(SEND_ERROR "${file}: a public header may not include ${header}, which is private")
        elseif(room STREQUAL "")
          message(SEND_ERROR "${file} lies in no room of tests/layering.cmake")
        else()
          check_private(${file} ${room} ${header})
        endif()
      elseif(NOT header MATCHES "^claystack_")  # made by CMake
        message(SEND_ERROR "${file}: ${header}: expected a path from the top of the project")
      endif()
    endforeach()
  endforeach()
endforeach()
if(seen LESS 1000)
  message(FATAL_ERROR "found only ${seen} includes: expected at least 1000")
endif()

# External libraries, by the rooms that may use them.
function(forbid folders pattern why)
  foreach(folder IN LISTS folders)
    file(GLOB_RECURSE files ${SOURCE}/${folder}/*.hpp ${SOURCE}/${folder}/*.cpp)
    foreach(file IN LISTS files)
      file(STRINGS ${file} hits REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]${pattern}")
      if(hits)
        file(RELATIVE_PATH name ${SOURCE} ${file})
        message(SEND_ERROR "${name}: ${why}: ${hits}")
      endif()
    endforeach()
  endforeach()
endfunction()

set(solids "(CGAL|OpenMesh|draco|meshoptimizer|gmp|mpfr)")
set(devices "(libusb|hidapi|ftdi|libftdi)")
set(windows "(GLFW|imgui|epoxy|EGL|GL/)")
forbid("core;engine;falcon" ${solids} "only export may use solid libraries")
forbid("core;engine;export;falcon/safety;falcon/sim" ${devices} "only falcon/device may use device libraries")
forbid("core;engine;export;falcon;app/cli;app/servo;app/history" ${windows} "only app/render and app/studio may draw")
forbid("core/include;engine/include;export/include;falcon/include;app/servo/include"
  "(CGAL|OpenMesh|draco|meshoptimizer|nlohmann|libusb|hidapi|ftdi|fmt|CLI)"
  "a public header may not include a library")
forbid("engine/clay;engine/tool;engine/tick;engine/collapse;engine/wheel" "nlohmann" "only engine/files may use JSON")
