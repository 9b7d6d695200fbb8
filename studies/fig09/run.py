#!/usr/bin/env python3
"""Runs the Fig. 9 study: the chosen set for several seeds, and one factor at a time around it.

Writes results.csv beside this script. A run that is done is not repeated. The smoking head is measured where numpy and
h5py are there (see smoking_head.py); without them its two columns stay empty.

  /usr/bin/python3 studies/fig09/run.py --spindrift build/release/spindrift --jobs 4
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))

SLOPES = {"gentle": "fig09c_gentle", "bumpy": "fig09a_bumpy", "steep": "fig09b_steep"}
ANGLES = {"gentle": 20, "bumpy": 30, "steep": 42}  # as in configs/paper [deg]
STOP = 9.0                                         # as in configs/paper [s]
LONGEST = 12.0                                     # the first seed's base run goes on to here [s]
STOP_TIMES = [6, 7.5, 9, 10.5, 12]                 # read from that one run [s]
FRAMES_PER_SECOND = 2                              # for the measure of the head [1/s]

# factor: (key of the scene, unit, values beside the chosen one, the chosen one)
FACTORS = {
    "friction_mu": ("dense_flow.friction_mu", "", [0.155, 0.35], 0.25),
    "friction_xi": ("dense_flow.friction_xi", "m/s^2", [500, 4000], 1000),
    "friction_acts_on": ("dense_flow.friction_acts_on", "", ["base", "none"], "column"),
    "cover_depth": ("cover.depth", "m", [0.315, 0.945], 0.525),
    "entrainment_rate": ("entrainment.rate", "", [5, 20], 10),
    "friction_strain": ("entrainment.friction_strain", "", [0, 10], 1),
    "compaction_time": ("dense_flow.compaction_time", "s", [0, 1], 0.1),
    "generation": ("coupling.generation.constant", "", [0.02], 0.2),
}
COLUMNS = ["slope", "factor", "value", "seed", "stop_time_s", "n_dense", "n_entrained", "front_speed_max_m_s",
           "cloud_height_max_m", "head_ratio", "smoking_share", "smoke_kg", "steps", "wall_s"]


class Case:
    """One run of the program: a slope, what is changed in its scene, the seed, and how long it lasts [s]."""

    def __init__(self, slope, factor, value, seed, settings=(), until=STOP, preview=False):
        self.slope, self.factor, self.value, self.seed = slope, factor, value, seed
        self.settings, self.until, self.preview = list(settings), until, preview

    @property
    def name(self):
        value = f"_{self.value}" if self.value != "" else ""
        return f"{self.slope}_{self.factor}{value}_seed{self.seed}"


def cases(seeds):
    """All runs of the study, the chosen set first."""
    out = []
    for slope in SLOPES:
        for seed in seeds:
            first = seed == seeds[0]
            out.append(Case(slope, "chosen", "", seed, until=LONGEST if first else STOP, preview=first))
    for change in (-4, 4):
        for slope, angle in ANGLES.items():
            settings = [f"terrain.angle={angle + change} deg"]
            out.append(Case(slope, "angle", angle + change, seeds[0], settings))
    for factor, (key, unit, values, _) in FACTORS.items():
        for value in values:
            setting = f"{key}={value} {unit}".strip()
            out += [Case(slope, factor, value, seeds[0], [setting]) for slope in SLOPES]
    return out


def run_json(folder):
    """The run's run.json, or {} where there is none."""
    try:
        with open(os.path.join(folder, "run.json")) as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def simulate(case, program, out, keep_frames):
    """Runs one case unless it is done, and measures its head. Returns its folder."""
    folder = os.path.join(out, case.name)
    measure_file = os.path.join(folder, "head.json")
    if run_json(folder).get("status") == "done" and (os.path.exists(measure_file) or not can_measure()):
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    command = [program, "run", os.path.join(ROOT, "configs", "paper", SLOPES[case.slope] + ".toml"), "-o", folder,
               "--seed", str(case.seed), "--until", str(case.until), "--threads", "1", "--quiet",
               "--frames-per-second", str(FRAMES_PER_SECOND)]
    if not case.preview:
        command.append("--no-preview")
    for setting in case.settings:
        command += ["--set", setting]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    if can_measure():
        import smoking_head
        with open(measure_file, "w") as file:
            json.dump(smoking_head.measure(folder), file)
        if not keep_frames:
            shutil.rmtree(os.path.join(folder, "frames"))
    return folder


def can_measure():
    """Are numpy and h5py there?"""
    try:
        import smoking_head  # noqa: F401
        return True
    except ImportError:
        return False


def head_until(folder, stop):
    """Median head ratio and share of frames with a smoking head up to a time [s], or empty strings."""
    if not can_measure():
        return "", ""
    try:
        with open(os.path.join(folder, "head.json")) as file:
            rows = json.load(file)
    except OSError:
        return "", ""
    import smoking_head
    ratio, share = smoking_head.summary(rows, stop + 0.1)
    return f"{ratio:.2f}", f"{share:.2f}"


def row_at(case, folder, factor, value, stop):
    """One row of results.csv: a run as it stood at a stop time [s]."""
    with open(os.path.join(folder, "diagnostics.csv")) as file:
        steps = [step for step in csv.DictReader(file) if float(step["time_s"]) <= stop + 1e-6]
    last = steps[-1]
    ratio, share = head_until(folder, stop)
    whole = math.isclose(stop, case.until)
    return {"slope": case.slope, "factor": factor, "value": value, "seed": case.seed, "stop_time_s": stop,
            "n_dense": last["n_dense"], "n_entrained": last["n_entrained"],
            "front_speed_max_m_s": f"{max(float(s['front_speed_m_s']) for s in steps):.2f}",
            "cloud_height_max_m": f"{max(float(s['cloud_height_m']) for s in steps):.2f}",
            "head_ratio": ratio, "smoking_share": share, "smoke_kg": f"{float(last['mass_smoke_kg']):.1f}",
            "steps": last["step"], "wall_s": f"{run_json(folder)['wall_seconds']:.1f}" if whole else ""}


def rows_of(case, folder):
    """The rows that one run gives: one, and one a stop time for the long runs."""
    if case.factor != "chosen":
        return [row_at(case, folder, case.factor, case.value, STOP)]
    rows = [row_at(case, folder, "chosen", "", STOP)]
    if case.until > STOP:
        rows += [row_at(case, folder, "stop_time", stop, stop) for stop in STOP_TIMES]
    return rows


def write_results(rows):
    """Writes results.csv: the rows of the runs that are done so far, in the order of the study."""
    with open(os.path.join(HERE, "results.csv"), "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spindrift", default=os.path.join(ROOT, "build", "release", "spindrift"), metavar="PATH",
                        help="the program (default: build/release/spindrift)")
    parser.add_argument("--out", default=os.path.join(ROOT, "runs", "fig09"), metavar="DIR",
                        help="where the run folders go (default: runs/fig09)")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4, 5], metavar="N",
                        help="seeds of the chosen set; the first one is used for all else (default: 1 2 3 4 5)")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="runs at the same time (default: 1)")
    parser.add_argument("--keep-frames", action="store_true", help="keep all frames (some 20 MB a run)")
    options = parser.parse_args()

    study, rows, failed = cases(options.seeds), [], 0
    os.makedirs(options.out, exist_ok=True)
    if not can_measure():
        print("numpy or h5py is missing: the smoking head is not measured", file=sys.stderr)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        waiting = [pool.submit(simulate, case, options.spindrift, options.out, options.keep_frames) for case in study]
        for number, (case, result) in enumerate(zip(study, waiting), 1):
            try:
                rows += rows_of(case, result.result())
                print(f"[{number}/{len(study)}] {case.name}", file=sys.stderr)
            except subprocess.CalledProcessError as error:
                failed += 1
                print(f"[{number}/{len(study)}] {case.name} failed: exit code {error.returncode}", file=sys.stderr)
            write_results(rows)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
