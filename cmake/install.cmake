# make install: libraries, headers, CMake package (components core, io and render), pkg-config
# files, program and man page.
include(CMakePackageConfigHelpers)

foreach(component core io render)
  set_target_properties(heightcast-${component} PROPERTIES
    EXPORT_NAME ${component}
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR})
  add_library(heightcast::${component} ALIAS heightcast-${component})
  install(TARGETS heightcast-${component} EXPORT heightcast-${component})
  install(EXPORT heightcast-${component} NAMESPACE heightcast::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/heightcast)
endforeach()
install(DIRECTORY include/heightcast DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY shaders DESTINATION ${CMAKE_INSTALL_DATADIR}/heightcast)

set(HC_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/heightcast)
configure_package_config_file(cmake/heightcast-config.cmake.in heightcast-config.cmake
  INSTALL_DESTINATION ${HC_PACKAGE})
write_basic_package_version_file(heightcast-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/heightcast-config.cmake
  ${PROJECT_BINARY_DIR}/heightcast-config-version.cmake DESTINATION ${HC_PACKAGE})

# A static library does not name what it needs, so its users must: there the private list is public.
file(RELATIVE_PATH HC_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(needs PUBLIC)
if(BUILD_SHARED_LIBS)
  set(needs PRIVATE)
endif()
set(HC_CORE_LIBS_${needs} "-lm -pthread")
set(HC_RENDER_LIBS_${needs} "-lm -pthread")
if(HEIGHTCAST_EPOXY_FOUND)
  set(HC_RENDER_LIBS_${needs} "-lm -pthread -ldl")
  set(HC_RENDER_REQUIRES_${needs} "epoxy >= 1.5")
endif()
set(HC_IO_LIBS_${needs} "-lOpenEXRCore -lm")
set(HC_IO_REQUIRES_${needs} "spng, libtiff-4 >= 4.5")
if(HEIGHTCAST_GDAL_FOUND)
  string(APPEND HC_IO_REQUIRES_${needs} ", gdal")
endif()
foreach(name heightcast heightcast-io heightcast-render)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

if(TARGET heightcast)
  if(BUILD_SHARED_LIBS) # found beside the program, wherever the prefix was moved to
    set_target_properties(heightcast PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  endif()
  install(TARGETS heightcast)
  install(FILES docs/heightcast.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
