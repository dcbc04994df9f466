# SPDX-License-Identifier: Apache-2.0
# cmake -D OUTPUT=page_files.cpp -D PAGE=folder -D FILES="a.js b.css" -P embed.cmake: the page as one C++ file.
set(types .html=text/html .css=text/css .js=text/javascript .svg=image/svg+xml)
separate_arguments(FILES)
set(text "// Made by apps/tunica/studio/embed.cmake.\n#include \"studio/page_files.hpp\"\nnamespace tunica::app::studio {\n")
string(APPEND text "namespace {\nconstexpr PageFile embedded[] = {\n")
foreach(file IN LISTS FILES)
  file(READ ${PAGE}/${file} code)
  get_filename_component(ending ${file} LAST_EXT)
  string(REGEX MATCH "${ending}=([a-z/+]+)" pair "${types}")
  string(APPEND text "{\"${file}\", \"${CMAKE_MATCH_1}; charset=utf-8\", R\"embedded(${code})embedded\"},\n")
endforeach()
string(APPEND text "};\n}  // namespace\nstd::span<const PageFile> page_files() { return embedded; }\n")
file(WRITE ${OUTPUT} "${text}}  // namespace tunica::app::studio\n")
