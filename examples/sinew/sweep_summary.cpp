// SPDX-License-Identifier: BSL-1.0
#include "sweep_summary.hpp"

#include "csv.hpp"
#include "json.hpp"
#include "sweep_table.hpp"

#include <sinew/core/error.hpp>

#include <cstdio>

namespace cli {

using sinew::text;

std::string amount(std::size_t n, std::string_view one, std::string_view many) {
  return text(n, ' ', n == 1 ? one : many);
}

void SweepSummary::count(std::size_t run, std::string_view line) {
  ++done;
  if (!has_error(line)) return;
  if (failed_++ > 0 && run > firstFailed_) return;
  const auto fields = csv_fields(line);
  firstFailed_ = run;
  firstError_ = fields ? fields->back() : "";
}

void SweepSummary::printStart() const {
  if (options_.output != Output::words) return;
  std::printf("%s: %s", options_.scene.path.c_str(), amount(runs_, "combination", "combinations").c_str());
  if (options_.parts > 1)
    std::printf(", of which part %d of %d has %zu", options_.part, options_.parts, part_);
  if (before > 0) std::printf("; %zu are in %s already", before, output_.c_str());
  if (ranks > 1) std::printf(", on %d ranks", ranks);
  std::printf("\n");
  if (!options_.duration.given)
    std::printf("%ld steps each; --steps or --time simulates more\n", options_.duration.steps);
  std::fflush(stdout);
}

void SweepSummary::printEnd() const {
  if (options_.output == Output::json) std::printf("%s\n", json({}).c_str());
  if (options_.output != Output::words) return;
  std::printf("%s in %.3g s", amount(done, "run", "runs").c_str(), seconds);
  if (failed_ > 0)
    std::printf("; %zu with an error, run %zu: %s", failed_, firstFailed_ + 1, firstError_.c_str());
  std::printf("\nwrote %s\n", output_.c_str());
  if (interrupted)
    std::printf(
        "interrupted; the table is whole, and the same command goes on with the %zu runs that are "
        "missing\n",
        part_ - before - done);
}

void SweepSummary::printFailure(std::vector<std::string> const& errors) const {
  if (options_.output == Output::json) std::printf("%s\n", json(errors).c_str());
}

std::string SweepSummary::json(std::vector<std::string> const& errors) const {
  return Json()
      .set("scene", options_.scene.path)
      .set("combinations", runs_)
      .set("part", part_)
      .set("before", before)
      .set("runs", done)
      .set("failed", failed_)
      .set("seconds", seconds)
      .set("file", output_)
      .set("interrupted", interrupted)
      .set("errors", errors)
      .text();
}

}  // namespace cli
