# cmake -DOUTPUT=FILE.cpp -DFILES=A;B -DNAMESPACE=N -P EmbedFiles.cmake: a source file that holds text
# files, each as `extern const std::string_view NAME` with the letters and digits of its file name.

set(source "#include <string_view>\n\nnamespace ${NAMESPACE} {\n\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(MAKE_C_IDENTIFIER ${name} name)
  file(READ ${file} text)
  if(text MATCHES "\\)embedded\"")
    message(FATAL_ERROR "${file} contains the end mark of a raw string")
  endif()
  string(APPEND source "extern const std::string_view ${name};\n"
                       "const std::string_view ${name} = R\"embedded(${text})embedded\";\n\n")
endforeach()
file(WRITE ${OUTPUT} "${source}}  // namespace ${NAMESPACE}\n")
