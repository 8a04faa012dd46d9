// SPDX-License-Identifier: BSL-1.0
// The module of typed scenes, which are known by their names.
#include "running.hpp"

#include <sinew/core/error.hpp>

page::Running page::run(std::string_view name) {
  if (name == "liver") return run_liver();
  if (name == "vitrectomy") return run_vitrectomy();
  throw sinew::Error("page", sinew::text("there is no scene '", name, "'; there are liver and vitrectomy"));
}
