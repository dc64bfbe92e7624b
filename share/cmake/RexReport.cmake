# The pages for browsers become part of the program: share/report for replays, share/live for the live page with
# three.js, its loader and controls, and share/watch for exercises.

find_path(REX_THREE three.min.js PATHS /usr/share/javascript/three NO_DEFAULT_PATH)
if(NOT REX_THREE)
  message(FATAL_ERROR "three.js is missing: install Debian package libjs-three")
endif()

# rex_three_js(VARIABLE PART ...): three.js with the parts that every page needs and these.
function(rex_three_js variable)
  file(READ ${REX_THREE}/three.min.js all)
  foreach(part loaders/GLTFLoader controls/OrbitControls lines/LineSegmentsGeometry lines/LineGeometry
          lines/LineMaterial lines/LineSegments2 lines/Line2 ${ARGN})
    file(READ ${REX_THREE}/examples/js/${part}.js text)
    string(APPEND all "\n${text}")
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

# rex_live_page(OUTPUT): writes a source file with the live page and all that it loads.
function(rex_live_page output)
  set(folder ${PROJECT_SOURCE_DIR}/share/live)
  set(report ${PROJECT_SOURCE_DIR}/share/report)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${folder}/page.html ${folder}/style.css ${folder}/live.js ${folder}/program.js ${folder}/controls.js ${report}/stage.js)
  file(READ ${folder}/page.html REX_LIVE_PAGE)
  file(READ ${folder}/style.css REX_LIVE_STYLE)
  file(READ ${report}/stage.js REX_LIVE_STAGE)
  file(READ ${folder}/controls.js REX_LIVE_CONTROLS)
  file(READ ${folder}/program.js REX_LIVE_PROGRAM)
  file(READ ${folder}/live.js REX_LIVE_SCRIPT)
  rex_three_js(REX_LIVE_THREEJS controls/TransformControls)
  configure_file(${PROJECT_SOURCE_DIR}/src/live/live_page.cpp.in ${output} @ONLY)
endfunction()

# rex_watch_page(OUTPUT): writes a source file with the page of `rex watch --open`.
function(rex_watch_page output)
  set(folder ${PROJECT_SOURCE_DIR}/share/watch)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${folder}/page.html ${folder}/style.css ${folder}/watch.js)
  file(READ ${folder}/page.html REX_WATCH_PAGE)
  file(READ ${folder}/style.css REX_WATCH_STYLE)
  file(READ ${folder}/watch.js REX_WATCH_SCRIPT)
  configure_file(${PROJECT_SOURCE_DIR}/src/cli/student/watch_files.cpp.in ${output} @ONLY)
endfunction()

# rex_report_page(OUTPUT): writes a source file with the template, the style, the scripts and the hashes that let
# a browser run them.
function(rex_report_page output)
  set(folder ${PROJECT_SOURCE_DIR}/share/report)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    ${folder}/page.html ${folder}/style.css ${folder}/stage.js ${folder}/viewer.js)
  file(READ ${folder}/page.html REX_REPORT_PAGE)
  file(READ ${folder}/style.css REX_REPORT_STYLE)
  file(READ ${folder}/stage.js REX_REPORT_VIEWER)
  file(READ ${folder}/viewer.js viewer)
  string(APPEND REX_REPORT_VIEWER "${viewer}")
  rex_three_js(REX_REPORT_THREEJS)
  if(REX_REPORT_VIEWER MATCHES "</[sS][cC][rR][iI][pP][tT]|<!--")
    message(FATAL_ERROR "viewer.js cannot stand in a page: it holds the end of a script")
  endif()
  foreach(part STYLE VIEWER THREEJS)
    string(SHA256 REX_REPORT_${part}_HASH "${REX_REPORT_${part}}")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/src/render/report_page.cpp.in ${output} @ONLY)
endfunction()
