// SPDX-License-Identifier: BSL-1.0
#include "csv.hpp"
#include "json.hpp"
#include "processes.hpp"
#include "sweep_plan.hpp"

#include "support/progress.hpp"

#include <sinew/io/text_reader.hpp>

#include <algorithm>
#include <cstdio>

namespace cli {

using sinew::text;

namespace {

// The key and the columns, from a process that reads the scene: this one stays small, and has no threads.
void look_at_scene(SweepPlan& plan) {
  Processes processes(plan.options.timeLimit);
  processes.start(0, [&] {
    std::string said = "0\n";
    auto failed = [&](int status, std::vector<std::string> const& messages) {
      said = text(status, '\n');
      for (auto const& m : messages) said += m + '\n';
    };
    try {
      said += plan.probe();
    } catch (Failure const& failure) {
      failed(failure.status, failure.messages);
    } catch (std::bad_alloc const&) {
      failed(badScene, {"sinew: there is not enough memory; make the scene smaller, or raise --max-memory"});
    } catch (std::exception const& error) {
      failed(badScene, {located(plan.options.scene.path, error.what())});
    }
    return said;
  });
  const auto ended = processes.wait();
  if (!ended) throw Failure{interrupted, {"interrupted"}};
  if (!ended->said) throw Failure{badScene, {text(plan.options.scene.path, ": ", ended->error)}};
  std::string_view rest = *ended->said;
  const int status = std::stoi(std::string(next_line(rest)));
  std::vector<std::string> lines;
  while (!rest.empty()) lines.emplace_back(next_line(rest));
  if (status != 0) throw Failure{status, std::move(lines)};
  plan.know(lines);
}

// what a sweep comes to
struct SweepSummary {
  std::string scene, output;
  std::size_t runs, part, before = 0, done = 0, failed = 0, firstFailed = 0;
  double seconds = 0;
  bool interrupted = false;
  std::string firstError{};

  Json json(std::vector<std::string> const& errors) const {
    return Json()
        .set("scene", scene)
        .set("combinations", runs)
        .set("part", part)
        .set("before", before)
        .set("runs", done)
        .set("failed", failed)
        .set("seconds", seconds)
        .set("file", output)
        .set("interrupted", interrupted)
        .set("errors", errors);
  }
};

std::string amount(std::size_t n, std::string_view one, std::string_view many) {
  return text(n, ' ', n == 1 ? one : many);
}

void run_missing(SweepPlan const& plan, SweepTable& table, std::vector<std::size_t> const& missing,
                 bool words, SweepSummary& summary) {
  Processes processes(plan.options.timeLimit);
  const auto jobs = std::size_t(plan.jobs());
  examples::Progress progress(long(std::max<std::size_t>(summary.part, 1)));
  examples::Stopwatch clock;
  clock.start();
  for (std::size_t next = 0; next < missing.size() || processes.size() > 0;) {
    while (next < missing.size() && processes.size() < jobs) {
      const std::size_t run = missing[next++];
      processes.start(run, [&plan, run] { return plan.run(run); });
    }
    const auto ended = processes.wait();
    if (!ended) break;
    std::string line = ended->said ? *ended->said : plan.failed(ended->job, ended->error);
    if (has_error(line)) {
      const auto fields = csv_fields(line);
      if (summary.failed++ == 0 || ended->job < summary.firstFailed) {
        summary.firstFailed = ended->job;
        summary.firstError = fields ? fields->back() : "";
      }
    }
    table.add(ended->job, std::move(line));
    ++summary.done;
    if (words) progress.at(long(summary.before + summary.done));
  }
  clock.stop();
  summary.seconds = clock.seconds();
  summary.interrupted = summary.done < missing.size();
  if (words && summary.interrupted && isatty(2)) std::fprintf(stderr, "\n");
}

int merge(SweepOptions const& options) {
  std::vector<std::string> paths = options.merge;
  // what is in the file that is to be written stays
  if (std::FILE* there = std::fopen(options.file.c_str(), "rb")) {
    std::fclose(there);
    paths.insert(paths.begin(), options.file);
  }
  SweepRows all;
  for (auto const& path : paths) {
    SweepRows table;
    try {
      table = read_sweep(path, sinew::io::read_file(path));
    } catch (sinew::Error const& error) {
      throw Failure{badScene, {error.what()}};
    }
    if (&path == &paths.front()) all.header = table.header;
    if (table.header.key != all.header.key || table.header.columns != all.header.columns)
      throw Failure{badUsage,
                    {text(path,
                          ": is a part of another sweep than ",
                          paths.front(),
                          ": '",
                          table.header.command,
                          "' and '",
                          all.header.command,
                          table.header.command == all.header.command
                              ? "', of another scene file, data or version of this program"
                              : "'")}};
    all.rows.insert(all.rows.end(), table.rows.begin(), table.rows.end());
  }
  sort_runs(all);
  std::string content = all.header.text();
  for (auto const& row : all.rows) content += text(row.second, '\n');
  writing([&] { sinew::io::write_file(options.file, content); });
  const std::size_t missing = all.header.runs - all.rows.size();
  if (options.output == Output::json)
    std::printf("%s\n",
                Json()
                    .set("combinations", all.header.runs)
                    .set("runs", all.rows.size())
                    .set("missing", missing)
                    .set("file", options.file)
                    .text()
                    .c_str());
  else if (options.output == Output::words)
    std::printf("wrote %s: %s of %zu%s\n",
                options.file.c_str(),
                amount(all.rows.size(), "run", "runs").c_str(),
                all.header.runs,
                missing == 0 ? ""
                             : text("; ",
                                    missing,
                                    " missing, which '",
                                    all.header.command,
                                    " --output ",
                                    options.file,
                                    "' does")
                                   .c_str());
  return ok;
}

}  // namespace

int sweep(SweepOptions const& options) {
  if (!options.merge.empty()) return merge(options);
  SweepPlan plan(options);
  const bool words = options.output == Output::words;
  catch_interrupt();
  const std::vector<std::size_t> part = plan.ofPart();
  SweepSummary summary{options.scene.path, plan.output, plan.combinations.size(), part.size()};
  try {
    look_at_scene(plan);
    SweepTable table(plan.output, plan.header, options.retry);
    std::vector<std::size_t> missing;
    for (const std::size_t run : part)
      if (!table.has(run)) missing.push_back(run);
    summary.before = part.size() - missing.size();
    if (words) {
      std::printf(
          "%s: %s", options.scene.path.c_str(), amount(summary.runs, "combination", "combinations").c_str());
      if (options.parts > 1)
        std::printf(", of which part %d of %d has %zu", options.part, options.parts, part.size());
      if (summary.before > 0) std::printf("; %zu are in %s already", summary.before, plan.output.c_str());
      std::printf("\n");
      if (!options.duration.given)
        std::printf("%ld steps each; --steps or --time simulates more\n", options.duration.steps);
      std::fflush(stdout);
    }
    run_missing(plan, table, missing, words, summary);
    table.sort();
  } catch (Failure const& failure) {
    if (options.output == Output::json) std::printf("%s\n", summary.json(failure.messages).text().c_str());
    throw;
  }
  if (options.output == Output::json) {
    std::printf("%s\n", summary.json(std::vector<std::string>{}).text().c_str());
  } else if (words) {
    std::printf("%s in %.3g s", amount(summary.done, "run", "runs").c_str(), summary.seconds);
    if (summary.failed > 0)
      std::printf("; %zu with an error, run %zu: %s",
                  summary.failed,
                  summary.firstFailed + 1,
                  summary.firstError.c_str());
    std::printf("\nwrote %s\n", plan.output.c_str());
    if (summary.interrupted)
      std::printf(
          "interrupted; the table is whole, and the same command goes on with the %zu runs that are "
          "missing\n",
          summary.part - summary.before - summary.done);
  }
  if (summary.interrupted) return interrupted;
  return ok;
}

}  // namespace cli
