# Included by `cmake --install`: copies to `target` (below $DESTDIR, if there is one) what students get of the exercise in
# `folder`. Of its sources that is what the program that they complete is made of, main.cpp, show.cpp and exercise.h with the
# headers that these include, so that no file of the checks can be among them; of other files, all but those of the gates.
cmake_policy(VERSION 3.25)
file(GLOB files RELATIVE ${folder} ${folder}/*)
list(FILTER files EXCLUDE REGEX "(\\.cpp|\\.h|\\.new|\\.d)$|^seen\\.txt$|^equal_mutants\\.tsv$|^rex-work-|^__pycache__$")
set(open main.cpp starter.cpp show.cpp exercise.h)
while(open)
  list(POP_FRONT open file)
  if(EXISTS ${folder}/${file} AND NOT file IN_LIST files)
    list(APPEND files ${file})
    file(STRINGS ${folder}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*\"")
    list(TRANSFORM lines REPLACE "^[^\"]*\"([^\"]*)\".*" "\\1")
    list(APPEND open ${lines})
  endif()
endwhile()
list(TRANSFORM files PREPEND ${folder}/)
file(INSTALL DESTINATION ${target} TYPE DIRECTORY FILES ${files} USE_SOURCE_PERMISSIONS)
