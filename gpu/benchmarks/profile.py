#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""What limits the scenes of `scenes` on a GPU, by NVIDIA's profiler: profile.py PROGRAM [SCENE...], where PROGRAM is
gpu_scenes and a SCENE is what that takes, in quotes, such as 'grid 24 13 15'. For each form of each scene one step is
looked at, kernel by kernel (of a fused one ten, which are one kernel). Printed are, of each kernel:

  launches   in a step
  us         of all of them, each alone on the GPU (so without the gaps between them), and their share of the sum
  memory     bytes that they move to and from the GPU's memory
  flops      additions and multiplications, one of both counted twice
  of peak    share of what the GPU could do of instructions, of traffic of L2 and of memory
  warps      at work at a time, of those that a multiprocessor could hold
  stalls     cycles that a warp waits between two instructions, and what for, the three longest
  local      reads and writes of numbers for which there was no register
"""
import argparse
import collections
import csv
import io
import re
import subprocess
import sys

SCENES = [("grid 24 13 15", "plain assembled fused"), ("grid 17 8 10", "fused"), ("block 4", "fused"),
          ("block 6", "plain assembled fused"), ("block 17", "plain assembled fused"), ("hexahedra 17", "assembled fused"),
          ("hyperelastic 17", "assembled fused"), ("block 55", "plain assembled"), ("batch 4 1024", "fused"),
          ("batch 7 1024", "fused")]
STALLS = ["barrier", "branch_resolving", "dispatch_stall", "drain", "imc_miss", "lg_throttle", "long_scoreboard",
          "math_pipe_throttle", "membar", "mio_throttle", "no_instruction", "not_selected", "short_scoreboard", "sleeping",
          "tex_throttle", "wait"]
STALL = "smsp__average_warps_issue_stalled_{}_per_issue_active.ratio"
MEANING = {"barrier": "other warps of the block", "lg_throttle": "room for loads", "long_scoreboard": "loads of memory or L2",
           "membar": "its writes to be seen", "mio_throttle": "room for shared memory", "no_instruction": "code",
           "short_scoreboard": "shared memory", "wait": "its last instruction", "not_selected": "its turn",
           "math_pipe_throttle": "arithmetic", "imc_miss": "constants", "drain": "its last writes",
           "branch_resolving": "branches"}
FLOPS = {f"smsp__sass_thread_inst_executed_op_{kind}{op}_pred_on.sum": 2 if op == "fma" else 1
         for kind in "fd" for op in ("add", "mul", "fma")}
TIME, MEMORY = "gpu__time_duration.sum", "dram__bytes.sum"
SHARES = {"instructions": "sm__throughput.avg.pct_of_peak_sustained_elapsed",
          "L2": "lts__throughput.avg.pct_of_peak_sustained_elapsed",
          "memory": "gpu__dram_throughput.avg.pct_of_peak_sustained_elapsed"}
WARPS = "sm__warps_active.avg.pct_of_peak_sustained_active"
LOCAL = ["smsp__inst_executed_op_local_ld.sum", "smsp__inst_executed_op_local_st.sum"]
METRICS = [TIME, MEMORY, WARPS, *SHARES.values(), *LOCAL, *FLOPS, *(STALL.format(s) for s in STALLS)]


def fail(message):
    print(f"profile.py: {message}", file=sys.stderr)
    sys.exit(1)


def without_arguments(name):
    """A name of C++ without the arguments of its templates."""
    while re.search(r"<[^<>]*>", name):
        name = re.sub(r"<[^<>]*>", "", name)
    return name.split("::")[-1].strip()


def short(kernel):
    """The function object of a loop or a sum, or the kernel itself."""
    found = re.search(r"(each_kernel|sum_kernel)<(.*)>\(", kernel)
    return without_arguments(found.group(2)) if found else without_arguments(kernel.split("(")[0])


def seconds_of(value, unit):
    return value * {"ns": 1e-9, "nsecond": 1e-9, "us": 1e-6, "usecond": 1e-6, "ms": 1e-3, "msecond": 1e-3, "s": 1}[unit]


def bytes_of(value, unit):
    return value * {"byte": 1, "Kbyte": 1e3, "Mbyte": 1e6, "Gbyte": 1e9}[unit]


def kernels_of(profiler, program, scene, form):
    """The kernels of one step, in their order: name, and its metrics."""
    command = [profiler, "--csv", "--page", "raw", "--clock-control", "none", "--cache-control", "none",
               "--profile-from-start", "off", "--metrics", ",".join(METRICS),
               program, *scene.split(), "--no-host", "--profile", form]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except FileNotFoundError as error:
        fail(f"there is no {error.filename}; give the path of gpu_scenes, and of ncu with --ncu")
    lines = [line for line in done.stdout.splitlines() if line.startswith('"')]
    if done.returncode != 0 or len(lines) < 3:
        fail(f"{' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    rows = list(csv.reader(io.StringIO("\n".join(lines))))
    header, units = rows[0], rows[1]
    unknown = [metric for metric in METRICS if metric not in header]
    if unknown:
        fail(f"{profiler} does not give {', '.join(unknown)}; take another version of it, or leave them out of METRICS")
    for row in rows[2:]:
        metrics = {}
        for title, unit, cell in zip(header, units, row):
            if title in METRICS:
                value = float(cell.replace(",", "")) if cell not in ("", "n/a") else 0.0
                metrics[title] = (seconds_of(value, unit) if title == TIME else bytes_of(value, unit) if title == MEMORY
                                  else value)
        yield short(row[header.index("Kernel Name")]), metrics


def report(scene, form, kernels):
    groups = collections.OrderedDict()
    for name, metrics in kernels:
        groups.setdefault(name, []).append(metrics)
    total = sum(m[TIME] for of in groups.values() for m in of)
    launches = sum(len(of) for of in groups.values())
    print(f"\n{scene}, {form}: {launches} launches, {total * 1e6:.1f} us of kernels")
    for name, of in sorted(groups.items(), key=lambda item: -sum(m[TIME] for m in item[1])):
        seconds = sum(m[TIME] for m in of)
        mean = lambda metric: sum(m[metric] * m[TIME] for m in of) / seconds
        stalls = sorted(((mean(STALL.format(s)), MEANING.get(s, s)) for s in STALLS), reverse=True)[:3]
        flops = sum(m[metric] * weight for m in of for metric, weight in FLOPS.items())
        local = sum(m[metric] for m in of for metric in LOCAL)
        print(f"  {name}: {len(of)} launches, {seconds * 1e6:.1f} us ({100 * seconds / total:.0f} %); "
              f"{sum(m[MEMORY] for m in of) / 1e6:.2f} MB; {flops / 1e6:.2f} Mflop; of peak: "
              + ", ".join(f"{what} {mean(metric):.0f} %" for what, metric in SHARES.items())
              + f"; warps {mean(WARPS):.0f} %; stalls: "
              + ", ".join(f"{cycles:.1f} for {what}" for cycles, what in stalls)
              + (f"; local {local:.0f}" if local else ""))
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", help="gpu_scenes")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="what gpu_scenes takes, in quotes")
    parser.add_argument("--forms", default="plain assembled fused", help="some of plain assembled fused, in quotes")
    parser.add_argument("--ncu", default="ncu", help="NVIDIA's profiler")
    options = parser.parse_args()
    for scene, forms in [(scene, options.forms) for scene in options.scenes] or SCENES:
        for form in forms.split():
            report(scene, form, kernels_of(options.ncu, options.program, scene, form))


if __name__ == "__main__":
    main()
