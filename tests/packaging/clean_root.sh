#!/usr/bin/env bash
# SPDX-License-Identifier: BSL-1.0
# clean_root.sh FOLDER: installs the Debian packages of FOLDER with apt in a new root of this Debian, and uses them there: the program runs
# a scene, and a program of the guide is compiled by the flags of pkg-config and by CMake's find_package. Needs mmdebstrap.
set -euo pipefail
packages=$(realpath "$1")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/use"
cp "$packages"/*.deb "$work/use"
cat >"$work/use/CMakeLists.txt" <<'TEXT'
cmake_minimum_required(VERSION 3.22)
project(use LANGUAGES CXX)
find_package(sinew REQUIRED)
add_executable(drag /usr/share/doc/libsinew-dev/examples/drag.cpp)
target_link_libraries(drag PRIVATE sinew::sinew)
TEXT
cat >"$work/use/use.sh" <<'TEXT'
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
cd /use
apt-get install -y --no-install-recommends /use/*.deb
says() { grep -qF "$1" "$2" || { cat "$2"; echo "$2 does not say '$1'"; exit 1; } >&2; }
sinew run /usr/share/doc/sinew/examples/beams.scn --steps 5 >run.txt
says '5 steps of' run.txt
sinew list UniformMass >list.txt
says 'vertexMass' list.txt
source /usr/share/bash-completion/completions/sinew
COMP_WORDS=(sinew run --ste) COMP_CWORD=2
_sinew
[ "${COMPREPLY[*]}" = --steps ]
zcat -f /usr/share/man/man1/sinew.1* >page.txt
says '.SH SINEW RUN' page.txt
g++ -std=c++20 -O1 /usr/share/doc/libsinew-dev/examples/drag.cpp $(pkg-config --cflags --libs sinew) -o drag
./drag >drag.txt
says 'falls at 56.029 m/s' drag.txt
cmake -B build -DCMAKE_BUILD_TYPE=Debug
cmake --build build
build/drag >drag.txt
says 'falls at 56.029 m/s' drag.txt
TEXT
. /etc/os-release
mmdebstrap --quiet --variant=apt --include=g++,cmake,make,pkg-config --customize-hook="copy-in $work/use /" \
  --customize-hook='chroot "$1" bash /use/use.sh' --format=null "$VERSION_CODENAME" /dev/null
