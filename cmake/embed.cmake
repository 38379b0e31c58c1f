# Text files into a C file: hc_shader_texts, one row for each of NAMES in FOLDER, NULL at the end.
set(arrays "")
set(rows "")
set(index 0)
foreach(name IN LISTS NAMES)
  file(READ ${FOLDER}/${name} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND arrays "static const char text_${index}[] = {\n${bytes}0 };\n")
  string(APPEND rows "    { \"${name}\", text_${index} },\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT} "/* Made by cmake/embed.cmake. */
#include \"gl/program.h\"

${arrays}
const hc_shader_text hc_shader_texts[] = {
${rows}    { 0, 0 },
};
")
