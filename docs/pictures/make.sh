#!/usr/bin/env bash
# SPDX-License-Identifier: BSL-1.0
# Makes the pictures of the pages anew, from the programs of build/demo: docs/pictures/make.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
programs=$PWD/build/demo/examples
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# the last picture of a scene: picture NAME SCENE STEPS OPTIONS...
picture() {
  local name=$1 scene=$2 steps=$3
  shift 3
  "$programs/sinew" run "examples/scenes/$scene.scn" --steps "$steps" --every "$steps" --png "$out/$name" --size 960x540 --quiet "$@"
  cp "$out/$name/000001.png" "docs/pictures/$name.png"
}

for name in beam floor; do
  (cd "$out" && "$programs/guide_$name" >/dev/null && cp "$name.png" "$OLDPWD/docs/pictures/$name.png")
done
picture stress liver 60 --colour vonMises
picture contacts contacts 150 --arrows contacts
picture fluid fluid 110 --colour speed --camera "10 7 24  0 2.5 -1"
picture fluid_grid fluid_grid 60 --camera "1.9 1.5 3.1  0.05 -0.2 -0.2"
picture stirred_tank stirred_tank 120 --camera "0.55 0.65 0.85  0 -0.05 0"
picture flooded_organ flooded_organ 70 --hide tank,tissue/skin --colour speed --camera "0.35 0.3 0.5  0 0.02 0"
picture bleeding_cut bleeding_cut 600 --hide tissue/surface --camera "0.05 0.14 0.13  0.01 0 0"
