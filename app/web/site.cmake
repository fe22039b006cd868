# cmake -DSITE=FOLDER "-DNOTICES=A|B" -P site.cmake: completes the folder of static files. One file
# with all notices, and in the service worker the names of the files and the version of the page, a
# hash of them.
string(REPLACE "|" ";" NOTICES "${NOTICES}")
set(whole "")
foreach(notice IN LISTS NOTICES)
  file(READ ${notice} text)
  string(APPEND whole "${text}\n")
endforeach()
file(WRITE ${SITE}/licences.txt "${whole}")

set(hashes "")
set(FILES "./")  # index.html
file(GLOB names RELATIVE ${SITE} ${SITE}/*)
list(REMOVE_ITEM names offline.js)
list(SORT names)
foreach(name IN LISTS names)
  file(SHA256 ${SITE}/${name} hash)
  string(APPEND hashes ${hash})
  if(NOT name STREQUAL index.html)
    string(APPEND FILES " ${name}")
  endif()
endforeach()
string(SHA256 version "${hashes}")
string(SUBSTRING ${version} 0 16 VERSION)
configure_file(${CMAKE_CURRENT_LIST_DIR}/page/offline.js ${SITE}/offline.js @ONLY)
