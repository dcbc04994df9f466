# SPDX-License-Identifier: Apache-2.0
# cmake -D OUTPUT=page.cpp -D VEGA=folder -D PAGE=folder -P embed.cmake: the scripts of the report as one C++ file.
# Vega's parts by the names they call each other.
set(modules
  vega-util=vega-util.min vega-time=vega-time.min vega-format=vega-format.min vega-loader=vega-loader.min
  vega-dataflow=vega-dataflow.min vega-statistics=vega-statistics.min vega-canvas=vega-canvas.browser
  vega-scale=vega-scale.min vega-scenegraph=vega-scenegraph.min vega-expression=vega-expression.min
  vega-event-selector=vega-event-selector.min vega-selections=vega-selection.min vega-functions=vega-functions.min
  vega-runtime=vega-runtime.min vega-view=vega-view.min vega-parser=vega-parser.min vega-encode=vega-encode.min
  vega-transforms=vega-transforms.min vega-view-transforms=vega-view-transforms.min vega-projection=vega-projection.min
  vega-geo=vega-geo.min vega-interpreter=vega-interpreter.min)
file(READ ${PAGE}/vega_license.txt license)
file(READ ${PAGE}/modules.js loader)
set(library "/*\n${license}*/\n${loader}")
foreach(module IN LISTS modules)
  string(REPLACE "=" ";" pair ${module})
  list(GET pair 0 name)
  list(GET pair 1 file)
  file(READ ${VEGA}/${file}.js code)
  string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" code "${code}")
  string(APPEND library "tunicaReport.define(\"${name}\",function(exports,require,module){${code}\n});\n")
endforeach()
set(script "")
foreach(part marks specs mesh charts pointer saving tables page)
  file(READ ${PAGE}/${part}.js code)
  string(APPEND script "${code}")
endforeach()
file(READ ${PAGE}/style.css style)
set(text "// Made by core/src/report/embed.cmake.\n#include \"report/page_parts.hpp\"\nnamespace tunica::report {\n")
foreach(part library script style)
  string(APPEND text "extern const std::string_view page_${part} = R\"embedded(\n${${part}})embedded\";\n")
endforeach()
file(WRITE ${OUTPUT} "${text}}  // namespace tunica::report\n")
