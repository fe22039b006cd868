# What is installed below share/: samples, schemas, pages, manual pages, completions, desktop files.
set(claystack_share ${PROJECT_BINARY_DIR}/share)
set(claystack_data ${CMAKE_INSTALL_DATADIR}/claystack)

# The program prints its manual pages and completions from its table of options.
set(commands batch doctor plan strokes throw)
foreach(part EXPORT=export EXPORT=check DRAWINGS=import WINDOW=render USB=devices STUDIO=studio BENCH=bench)
  string(REPLACE = ";" part ${part})
  list(GET part 0 option)
  list(GET part 1 command)
  if(CLAYSTACK_${option})
    list(APPEND commands ${command})
  endif()
endforeach()
set(manual_commands
  COMMAND ${CMAKE_COMMAND} -E make_directory ${claystack_share}
  COMMAND $<TARGET_FILE:claystack> manual claystack > ${claystack_share}/claystack.1
  COMMAND $<TARGET_FILE:claystack> manual bash > ${claystack_share}/claystack.bash
  COMMAND $<TARGET_FILE:claystack> manual zsh > ${claystack_share}/claystack.zsh
  COMMAND $<TARGET_FILE:claystack> manual fish > ${claystack_share}/claystack.fish)
set(pages ${claystack_share}/claystack.1)
foreach(command IN LISTS commands)
  set(page ${claystack_share}/claystack-${command}.1)
  list(APPEND manual_commands COMMAND $<TARGET_FILE:claystack> manual ${command} > ${page})
  list(APPEND pages ${page})
endforeach()
set(shell_scripts ${claystack_share}/claystack.bash ${claystack_share}/claystack.zsh
  ${claystack_share}/claystack.fish)
# OPTIONAL: a build of the programs alone has no pages yet.
if(NOT CMAKE_CROSSCOMPILING)
  # gzip -n: without the time, so that two builds give the same bytes.
  add_custom_command(OUTPUT ${pages} ${shell_scripts} ${manual_commands}
    COMMAND gzip -9nkf ${pages}
    DEPENDS claystack VERBATIM)
  add_custom_target(manual ALL DEPENDS ${pages})
  list(TRANSFORM pages APPEND .gz)
  set(studio_pages ${pages})
  list(FILTER studio_pages INCLUDE REGEX "claystack-studio")
  list(FILTER pages EXCLUDE REGEX "claystack-studio")
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
  install(FILES ${studio_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT studio OPTIONAL)
  install(FILES ${claystack_share}/claystack.bash RENAME claystack COMPONENT program
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions OPTIONAL)
  install(FILES ${claystack_share}/claystack.zsh RENAME _claystack COMPONENT program
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions OPTIONAL)
  install(FILES ${claystack_share}/claystack.fish COMPONENT program
    DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d OPTIONAL)
endif()

install(DIRECTORY samples/ DESTINATION ${claystack_data}/samples COMPONENT program
  FILES_MATCHING
  PATTERN "*.json" PATTERN "*.jsonl" PATTERN "*.session" PATTERN "*.work" PATTERN "*.svg" PATTERN "*.dxf"
  PATTERN "*.csv" PATTERN "*.script" PATTERN "*.py" PATTERN "sha256sums"
  PATTERN "consumer" EXCLUDE PATTERN "replay" EXCLUDE)
install(DIRECTORY samples/consumer/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libclaystack-dev/examples COMPONENT dev)

# The pages, with links between installed files.
set(claystack_doc ${CMAKE_INSTALL_FULL_DATADIR}/doc/claystack)
file(RELATIVE_PATH to_samples ${claystack_doc} ${CMAKE_INSTALL_FULL_DATADIR}/claystack/samples)
file(RELATIVE_PATH to_headers ${claystack_doc} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
file(GLOB doc_pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} *.md docs/*.md)
set(installed_pages ${doc_pages})
list(TRANSFORM doc_pages PREPEND ${PROJECT_SOURCE_DIR}/)
list(TRANSFORM installed_pages PREPEND ${claystack_share}/pages/)
set(links_script ${PROJECT_SOURCE_DIR}/cmake/InstalledPages.cmake)
add_custom_command(OUTPUT ${installed_pages}
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${claystack_share}/pages
          -DSAMPLES=${to_samples} -DEXAMPLES=../libclaystack-dev/examples -DHEADERS=${to_headers}
          -P ${links_script}
  DEPENDS ${doc_pages} ${links_script} VERBATIM)
add_custom_target(pages ALL DEPENDS ${installed_pages})
if(TARGET manual)
  add_dependencies(manual pages)
endif()
install(DIRECTORY ${claystack_share}/pages/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/claystack
  COMPONENT program OPTIONAL)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/claystack/docs COMPONENT program
  FILES_MATCHING PATTERN "*.svg" PATTERN "*.png")

if(CLAYSTACK_STUDIO)
  set(desktop ${PROJECT_SOURCE_DIR}/app/desktop)
  set(id org.claystack.Claystack)
  install(FILES ${desktop}/${id}.desktop COMPONENT studio
    DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  configure_file(${desktop}/${id}.metainfo.xml.in ${claystack_share}/${id}.metainfo.xml @ONLY)
  install(FILES ${claystack_share}/${id}.metainfo.xml COMPONENT studio
    DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
  install(FILES ${desktop}/${id}.mime.xml RENAME ${id}.xml COMPONENT studio
    DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
  install(FILES ${desktop}/claystack.thumbnailer COMPONENT studio
    DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
  set(icons ${CMAKE_INSTALL_DATADIR}/icons/hicolor)
  install(FILES ${desktop}/${id}.svg DESTINATION ${icons}/scalable/apps COMPONENT studio)
  foreach(size 48 64 128 256)
    install(FILES ${desktop}/${id}-${size}.png RENAME ${id}.png COMPONENT studio
      DESTINATION ${icons}/${size}x${size}/apps)
  endforeach()
endif()
