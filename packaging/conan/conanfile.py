# SPDX-License-Identifier: BSL-1.0
"""A recipe for Conan 2, of this checkout: conan create packaging/conan

The package is what CMake installs without a build, headers and Sinew's own files for find_package(sinew), so that all targets of
README.md that need no library of Sinew are there."""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Sinew(ConanFile):
    name = "sinew"
    license = "BSL-1.0"
    description = "Simulation of soft tissue, springs and rigid bodies, header-only, in C++20"
    package_type = "header-library"
    settings = "os", "compiler", "build_type", "arch"
    requires = ("eigen/[>=3.4 <6]", "boost/[>=1.74]")
    default_options = {"boost/*:header_only": True}  # of Boost, Hana is all that is needed
    no_copy_source = True

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        with open(os.path.join(self._root, "include", "sinew", "version.hpp"), encoding="utf-8") as file:
            self.version = ".".join(re.findall(r"define SINEW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", file.read()))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "src/*", "include/*", "gpu/include/*"):
            copy(self, pattern, self._root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False  # nothing is written beside the sources
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")  # find_package reads Sinew's own files
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "sinew")]
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        if self.settings.os == "Linux":
            self.cpp_info.system_libs = ["pthread"]

    def package_id(self):
        self.info.clear()
