# SPDX-License-Identifier: BSL-1.0
"""A recipe for Conan 2, of this checkout: conan create packaging/conan"""
import os
import re

from conan import ConanFile
from conan.tools.files import copy


class Sinew(ConanFile):
    name = "sinew"
    license = "BSL-1.0"
    description = "Simulation of soft tissue, springs and rigid bodies, header-only, in C++20"
    package_type = "header-library"
    requires = ("eigen/[>=3.4 <4]", "boost/[>=1.74]")
    no_copy_source = True

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        text = open(os.path.join(self._root, "include", "sinew", "version.hpp")).read()
        self.version = ".".join(re.findall(r"define SINEW_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))

    def export_sources(self):
        for folder in ("include", "gpu/include"):
            copy(self, "*.hpp", os.path.join(self._root, folder), os.path.join(self.export_sources_folder, "include"))
        copy(self, "LICENSE", self._root, self.export_sources_folder)

    def package(self):
        copy(self, "*.hpp", os.path.join(self.source_folder, "include"), os.path.join(self.package_folder, "include"))
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_target_name", "sinew::sinew")
        self.cpp_info.bindirs = self.cpp_info.libdirs = []

    def package_id(self):
        self.info.clear()
