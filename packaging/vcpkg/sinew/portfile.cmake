# An overlay port of this checkout: vcpkg install sinew --overlay-ports=packaging/vcpkg
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}" OPTIONS -DCMAKE_INSTALL_LIBDIR=share)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/sinew)
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug")  # there are headers only
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
