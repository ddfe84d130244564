# Run by CPack on the files of the packages before it packs them: libraries stand in Debian's folders, where the loader
# looks by itself, so that no path is left in them.
file(GLOB_RECURSE files LIST_DIRECTORIES false "${CPACK_TEMPORARY_DIRECTORY}/*")
foreach(file IN LISTS files)
  if(NOT IS_SYMLINK "${file}" AND (file MATCHES "\\.so(\\.[0-9.]+)?$" OR file MATCHES "/bin/railstrata$"))
    file(RPATH_REMOVE FILE "${file}")
    if(file MATCHES "\\.so(\\.[0-9.]+)?$")  # libraries are read, not run
      file(CHMOD "${file}" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
    endif()
  endif()
endforeach()
