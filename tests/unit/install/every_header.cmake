# Writes a source that includes all installed headers: none needs a file that is not installed.
file(GLOB_RECURSE headers RELATIVE ${INCLUDE} ${INCLUDE}/*.hpp)
if(NOT headers)
  message(FATAL_ERROR "no headers under ${INCLUDE}")
endif()
list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
file(WRITE ${OUT} ${headers})
