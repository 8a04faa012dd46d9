// SPDX-License-Identifier: BSL-1.0
#include "csv.hpp"
#include "json.hpp"
#include "processes.hpp"
#include "sweep_plan.hpp"
#include "sweep_summary.hpp"

#include "support/progress.hpp"

#include <sinew/io/text_reader.hpp>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
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

void run_missing(SweepPlan const& plan, SweepTable& table, std::vector<std::size_t> const& missing,
                 bool words, SweepSummary& summary) {
  Processes processes(plan.options.timeLimit);
  const auto jobs = std::size_t(plan.jobs());
  examples::Progress progress(long(std::max<std::size_t>(summary.part(), 1)));
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
    summary.count(ended->job, line);
    table.add(ended->job, std::move(line));
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

void say(std::string_view lines) {
  while (!lines.empty()) {
    const ssize_t n = ::write(1, lines.data(), lines.size());
    if (n < 0 && errno != EINTR) throw Failure{interrupted, {}};  // nobody listens any more
    if (n > 0) lines.remove_prefix(std::size_t(n));
  }
}

// For a rank of `sinew sweep --mpi`, which has started this process: says what the sweep is, then runs what
// standard input has the numbers of, a line each, and says the lines of the table, until that ends.
int work(SweepPlan& plan) {
  try {
    look_at_scene(plan);
  } catch (Failure const& failure) {
    std::string said = text(failure.status, ' ', failure.messages.size(), '\n');
    for (auto const& message : failure.messages) said += message + '\n';
    say(said);
    return failure.status;
  }
  say(text("0 3\n", plan.output, '\n', plan.header.text()));
  Processes processes(plan.options.timeLimit);
  std::string told;
  for (;;) {
    if (const auto ended = processes.wait(STDIN_FILENO)) {
      say(ended->said ? *ended->said + '\n' : plan.failed(ended->job, ended->error) + '\n');
      continue;
    }
    if (was_interrupted()) return interrupted;
    char bytes[4096];
    const ssize_t n = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return ok;
    told.append(bytes, std::size_t(n));
    for (std::size_t end; (end = told.find('\n')) != told.npos; told.erase(0, end + 1)) {
      const auto run = std::size_t(std::stoul(told.substr(0, end)));
      processes.start(run, [&plan, run] { return plan.run(run); });
    }
  }
}

}  // namespace

int sweep(SweepOptions const& options) {
  if (!options.merge.empty()) return merge(options);
  SweepPlan plan(options);
  catch_interrupt();
  if (options.worker >= 0) return work(plan);
  const std::vector<std::size_t> part = plan.ofPart();
  SweepSummary summary(options, plan.output, plan.combinations.size(), part.size());
  try {
    look_at_scene(plan);
    SweepTable table(plan.output, plan.header, options.retry);
    std::vector<std::size_t> missing;
    for (const std::size_t run : part)
      if (!table.has(run)) missing.push_back(run);
    summary.before = part.size() - missing.size();
    summary.printStart();
    run_missing(plan, table, missing, options.output == Output::words, summary);
    table.sort();
  } catch (Failure const& failure) {
    summary.printFailure(failure.messages);
    throw;
  }
  summary.printEnd();
  return summary.interrupted ? interrupted : ok;
}

}  // namespace cli
