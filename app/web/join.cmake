# cmake -DOUTPUT=FILE "-DPARTS=A|B" -P join.cmake: one text file after the other.
string(REPLACE "|" ";" PARTS "${PARTS}")
set(whole "")
foreach(part IN LISTS PARTS)
  file(READ ${part} text)
  string(APPEND whole "${text}\n")
endforeach()
file(WRITE ${OUTPUT} "${whole}")
