# smopt_read_files(<file>:<NAME> …): the content of each file in the variable NAME, for configure_file to put into a source; configured anew when one
# of them changes. Data become part of the library so that an installed program needs no path to them.
macro(smopt_read_files)
  foreach(file_and_name ${ARGN})
    string(REPLACE ":" ";" file_and_name ${file_and_name})
    list(GET file_and_name 0 embedded_file)
    list(GET file_and_name 1 embedded_name)
    file(READ ${embedded_file} ${embedded_name})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${embedded_file})
  endforeach()
endmacro()
