// SPDX-License-Identifier: BSL-1.0
#include "running.hpp"

#include "vitrectomy/options.hpp"
#include "vitrectomy/scene.hpp"

page::Running page::run_vitrectomy() {
  const examples::VitrectomyOptions options;
  return initialised(
      "vitrectomy", examples::vitrectomy_scene(examples::make_eye({.sectors = options.sectors})), options.dt);
}
