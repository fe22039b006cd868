# cmake -DSOURCE=... -DOUTPUT=... -DSAMPLES=... -DEXAMPLES=... -DHEADERS=... -P InstalledPages.cmake:
# copies README and the other pages, with links to installed files instead of files of the source.
# The last three are folders, relative to that of README.

file(GLOB pages RELATIVE ${SOURCE} ${SOURCE}/*.md ${SOURCE}/docs/*.md)
foreach(page IN LISTS pages)
  file(READ ${SOURCE}/${page} text)
  set(up "](")
  if(page MATCHES "^docs/")
    set(up "](../")
  endif()
  # Debian has the licence once for all packages; ours has its name in `copyright`.
  string(REPLACE "${up}LICENSE)" "${up}copyright)" text "${text}")
  string(REPLACE "${up}samples/consumer)" "${up}${EXAMPLES})" text "${text}")
  string(REPLACE "${up}samples)" "${up}${SAMPLES})" text "${text}")
  string(REPLACE "${up}samples/" "${up}${SAMPLES}/" text "${text}")
  foreach(component engine export falcon app/servo)
    string(REPLACE "${up}${component}/include/" "${up}${HEADERS}/" text "${text}")
  endforeach()
  file(WRITE ${OUTPUT}/${page} "${text}")
endforeach()
