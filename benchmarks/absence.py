#!/usr/bin/env python3
"""What every part of a scene costs, and that an absent part costs nothing: measures, and writes docs/absence.md.

./dev absence builds what it needs and runs it. Times come from build/release, instructions from build/counted, since
valgrind does not know every instruction of the newest machines. Ends with code 1 where an absent part has a cost.
"""

import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIMED, COUNTED = ROOT / "build/release", ROOT / "build/counted"
WARM, TIMED_STEPS = 20, 200
COUNTED_STEPS = 32  # a multiple of the steps between two copies of the state
ALLOWED_SHARE = 1e-3

# name, arguments of the program without the rest, the scene's number of parts (0: air alone)
PAIRS = [
    ("dense flow", ["absence_dense", "{steps}", "bare"], 1),
    ("dense flow, cover", ["absence_dense", "{steps}", "cover"], 2),
    ("air and smoke", ["absence_air", "{steps}"], 0),
]

PAGE = """# The cost of what is not needed

Written by `./dev absence` ([benchmarks/absence.py](../benchmarks/absence.py)). Instructions are the same on every run
up to about one in 10 000; milliseconds are the machine's. One thread, 2D: 672 particles, 80 x 48 cells.

## What every part costs

Each row has the parts of all rows above it. Milliseconds and allocations are medians of {timed} steps after {warm} warm
ones, the rows taking turns step by step; bytes are those of state and scratch after these steps, the copy to go back to
from a failed step included; instructions are means of {counted} steps after the warm ones, in a build for any machine.

| scene | ms a step | state and scratch [kB] | allocations a warm step | instructions a step [million] |
| --- | ---: | ---: | ---: | ---: |
{costs}

The first row with a suspension has the core's part of it: the air gives way to the snow, and pushes back.

## What an absent part costs

The same steps, once by the simulation from a scene that leaves the rest out, once by a small program that calls the
classes of `src/sph` or `src/grid` one after the other and is not linked with the simulation, coupling or entrainment.
Both keep the ledger, check the state and copy it every 16 steps: this belongs to what is there, not to what is absent.

| scene | composed without the rest | simulation | share | same bits after {last} steps |
| --- | ---: | ---: | ---: | --- |
{shares}

Instructions a step in user mode, by valgrind's callgrind; the difference of runs of {warm} and of {last} steps leaves
out the set-up. Allowed are {allowed:.1f} %. A negative share is what another inlining of the same lines makes.

`tests/simulation/test_alone.cpp` holds the equality of bits in every build, `tests/simulation/test_absence.cpp` that an
absent part takes no pass, no byte and no allocation. The snow of a scene with a suspension, but without a coupling, has
the bits of the scene without a suspension as long as no cell is core (outside overlap, half filled with snow) and the
air does not rule the time step; from the first core cell on the air answers the snow: physics, not overhead.
"""


def output_of(command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True)


def instructions_a_step(program, arguments):
    """Mean over COUNTED_STEPS after WARM steps; None without valgrind."""
    if not shutil.which("valgrind"):
        return None

    def total(steps):
        command = [COUNTED / program] + [argument.format(steps=steps) for argument in arguments]
        told = output_of(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command]).stderr
        return int(re.search(r"Collected : (\d+)", told)[1])

    return (total(WARM + COUNTED_STEPS) - total(WARM)) / COUNTED_STEPS


def cost_rows():
    rows = []
    table = output_of([TIMED / "absence", "table", WARM, TIMED_STEPS]).stdout
    for n_parts, line in enumerate(table.splitlines(), 1):
        name, size, milliseconds, allocations = line.split("\t")
        count = instructions_a_step("absence", ["steps", "{steps}", str(n_parts)])
        counted = "not counted" if count is None else f"{count / 1e6:.3f}"
        name = name if n_parts == 1 else "+ " + name
        rows.append(f"| {name} | {float(milliseconds):.3f} | {int(size) / 1e3:.0f} | {allocations} | {counted} |")
    return rows


def share_rows():
    """The rows, and whether absent parts cost nothing."""
    rows, good = [], True
    last = WARM + COUNTED_STEPS
    for name, (program, *arguments), n_parts in PAIRS:
        scene = ["steps", "{steps}", str(n_parts)]
        same = (output_of([COUNTED / program] + [argument.format(steps=last) for argument in arguments]).stdout
                == output_of([COUNTED / "absence"] + [argument.format(steps=last) for argument in scene]).stdout)
        without, simulated = instructions_a_step(program, arguments), instructions_a_step("absence", scene)
        good = good and same
        if without is None:
            counts = "not counted | not counted | valgrind is missing"
        else:
            share = simulated / without - 1
            good = good and share <= ALLOWED_SHARE
            counts = f"{without:,.0f} | {simulated:,.0f} | {100 * share:+.4f} %".replace(",", " ")
        rows.append(f"| {name} | {counts} | {'yes' if same else 'NO'} |")
    return rows, good


def main():
    shares, good = share_rows()
    page = PAGE.format(costs="\n".join(cost_rows()), shares="\n".join(shares), warm=WARM, timed=TIMED_STEPS,
                       counted=COUNTED_STEPS, last=WARM + COUNTED_STEPS, allowed=100 * ALLOWED_SHARE)
    (ROOT / "docs/absence.md").write_text(page)
    print(page)
    return 0 if good else "an absent part has a cost: see the page above"


if __name__ == "__main__":
    sys.exit(main())
