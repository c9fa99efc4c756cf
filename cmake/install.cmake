# cmake --install: program, library, headers, scenes, schemas, what render farms run, man pages, completions, documents, and
# the package for find_package(raytrace).
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/raytrace)

install(TARGETS raytrace_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS raytrace_openimageio LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/raytrace)
if(TARGET raytrace_convert)
  install(TARGETS raytrace_convert RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/raytrace)
endif()
install(TARGETS raytrace EXPORT raytraceTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

install(CODE "
  set(SOURCE \"${PROJECT_SOURCE_DIR}/lib\")
  get_filename_component(FOLDER \"${CMAKE_INSTALL_INCLUDEDIR}\" ABSOLUTE BASE_DIR \"\${CMAKE_INSTALL_PREFIX}\")
  include(\"${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake\")")

# With the small files that they name. Those in models/ are of models that are fetched into the build.
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/raytrace
  FILES_MATCHING PATTERN "*.xml" PATTERN "*.xsd" PATTERN "*.png" PATTERN "*.ply" PATTERN "*.gltf" PATTERN "*.ies"
  REGEX "/scenes/models/[^/]*[.]xml$" EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/share/man/man1/raytrace.1 ${PROJECT_BINARY_DIR}/share/man/man1/raytrace-merge.1
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(DIRECTORY share/openjd share/slurm DESTINATION ${CMAKE_INSTALL_DATADIR}/raytrace)
install(FILES share/statistics.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/raytrace)
foreach(file bash-completion/completions/raytrace zsh/site-functions/_raytrace fish/vendor_completions.d/raytrace.fish)
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${PROJECT_BINARY_DIR}/share/${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder})
endforeach()

# As they lie in the repository, so that their links and pictures are found.
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.jpg" PATTERN "*.svg" PATTERN "*.json")

install(EXPORT raytraceTargets NAMESPACE raytrace:: DESTINATION ${package_folder})
string(REGEX MATCH "^[0-9]+" embree_major "${embree_VERSION}")
configure_package_config_file(cmake/raytraceConfig.cmake.in ${PROJECT_BINARY_DIR}/raytraceConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/raytraceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/raytraceConfig.cmake ${PROJECT_BINARY_DIR}/raytraceConfigVersion.cmake
    cmake/package_faults.cmake
  DESTINATION ${package_folder})
