# Mends what Debian's packages of our dependencies say wrongly about themselves. For the build, and for the users of the
# installed library, whose configuration file includes this one too.

# OpenImageIO 2.4 names header folders of packages that it does not depend on, which CMake refuses.
if(TARGET OpenImageIO::OpenImageIO)
  get_target_property(raytrace_folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
  foreach(folder IN LISTS raytrace_folders)
    if(NOT EXISTS ${folder})
      list(REMOVE_ITEM raytrace_folders ${folder})
    endif()
  endforeach()
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${raytrace_folders}")
endif()

# xsimd has only headers, but wants to be linked with xtl, which is there for its batches of xtl's complex numbers.
if(NOT TARGET xtl)
  set_target_properties(xsimd PROPERTIES INTERFACE_LINK_LIBRARIES "")
endif()
