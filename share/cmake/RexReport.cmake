# The page of a replay becomes part of the program: share/report, and three.js with its loader and controls.

find_path(REX_THREE three.min.js PATHS /usr/share/javascript/three NO_DEFAULT_PATH)
if(NOT REX_THREE)
  message(FATAL_ERROR "three.js is missing: install Debian package libjs-three")
endif()

# rex_report_page(OUTPUT): writes a source file with the template, the style, the scripts and the hashes that let
# a browser run them.
function(rex_report_page output)
  set(folder ${PROJECT_SOURCE_DIR}/share/report)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${folder}/page.html ${folder}/style.css ${folder}/viewer.js)
  file(READ ${folder}/page.html REX_REPORT_PAGE)
  file(READ ${folder}/style.css REX_REPORT_STYLE)
  file(READ ${folder}/viewer.js REX_REPORT_VIEWER)
  file(READ ${REX_THREE}/three.min.js REX_REPORT_THREEJS)
  foreach(part loaders/GLTFLoader controls/OrbitControls lines/LineSegmentsGeometry lines/LineGeometry
          lines/LineMaterial lines/LineSegments2 lines/Line2)
    file(READ ${REX_THREE}/examples/js/${part}.js text)
    string(APPEND REX_REPORT_THREEJS "\n${text}")
  endforeach()
  if(REX_REPORT_VIEWER MATCHES "</[sS][cC][rR][iI][pP][tT]|<!--")
    message(FATAL_ERROR "viewer.js cannot stand in a page: it holds the end of a script")
  endif()
  foreach(part STYLE VIEWER THREEJS)
    string(SHA256 REX_REPORT_${part}_HASH "${REX_REPORT_${part}}")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/src/render/report_page.cpp.in ${output} @ONLY)
endfunction()
