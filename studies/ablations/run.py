#!/usr/bin/env python3
"""Runs Figs. 10, 11 and 12 and prints what docs/ablations.md tells of them; draws docs/pictures/ablations.png.

A run that is done is not repeated. Needs numpy, h5py, matplotlib and Pillow.

  /usr/bin/python3 studies/ablations/run.py --spindrift build/release/spindrift --jobs 2
"""
import argparse
import concurrent.futures
import json
import os
import subprocess
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image, ImageDraw, ImageFont  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tools"))
from spindrift_reader import Run  # noqa: E402

# name: (label, scene, seeds, settings)
SCENES = {
    "everything": ("10 (a), 11 (a): everything", "fig11a_entrainment", [1, 2, 3], []),
    "no_smoke": ("10 (b): no generation, no adhesion", "fig10b_no_generation_adhesion", [1], []),
    "no_forces": ("10 (c): no drag, no lift", "fig10c_no_forces", [1], []),
    "no_entrainment": ("11 (b): no entrainment", "fig11b_no_entrainment", [1, 2, 3], []),
    "cliff": ("12: cliff", "fig12_cliff", [1], []),
    "fixed_core": ("everything, core at rest", "fig11a_entrainment", [1], ["suspension.moving_core=false"]),
    "fixed_core_no_forces": ("no drag, no lift, core at rest", "fig10c_no_forces", [1],
                             ["suspension.moving_core=false"]),
}
PICTURES = ["everything", "no_smoke", "no_forces", "no_entrainment"]
CLOUD = 0.1             # smoke that counts as cloud [kg/m^3]
OUTLINES = (5.0, 9.0)   # over which the outline is averaged [s]
PICTURE_AT = 8.0        # [s]
TILE = (700, 340)       # of a preview [pixels]
LEFT, TOP = 150, 120    # of the tile in the preview [pixels]


def outline(run):
    """Length of the cloud's outline over the square root of its area, mean over OUTLINES [-]."""
    ratios = []
    for number, time in zip(run.frames("smoke"), run.times):
        if not OUTLINES[0] - 1e-6 <= time <= OUTLINES[1] + 1e-6:
            continue
        density = run.smoke(number)["density"]
        area = np.count_nonzero(density > CLOUD)
        if area == 0:
            continue
        lines = plt.figure().gca().contour(density, [CLOUD]).allsegs[0]
        plt.close("all")
        length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)
        ratios.append(length / np.sqrt(area))
    return float(np.mean(ratios)) if ratios else float("nan")


def execute(program, out, name, seed):
    """Runs one scene with one seed unless it is done; returns its folder."""
    folder = os.path.join(out, f"{name}_seed{seed}")
    try:
        with open(os.path.join(folder, "run.json")) as file:
            if json.load(file)["status"] == "done":
                return folder
    except (OSError, ValueError):
        pass
    _, scene, _, settings = SCENES[name]
    command = [program, "run", os.path.join(ROOT, "configs", "paper", scene + ".toml"), "-o", folder, "--overwrite",
               "--seed", str(seed), "--threads", "1", "--quiet"]
    subprocess.run(command + [word for setting in settings for word in ("--set", setting)], check=True,
                   stdout=subprocess.DEVNULL)
    print(f"{name}, seed {seed}", file=sys.stderr)
    return folder


def row(name, seed, folder):
    """One row of the table in docs/ablations.md."""
    run = Run(folder)
    steps = run.diagnostics
    cells = [SCENES[name][0], f"{seed}", f"{int(steps['n_dense'][-1]):,}", f"{steps['front_m'][-1]:.1f}",
             f"{np.max(steps['front_speed_m_s']):.1f}", f"{np.max(steps['cloud_height_m']):.1f}",
             f"{steps['mass_smoke_kg'][-1]:,.0f}", f"{outline(run):.1f}"]
    return "| " + " | ".join(cells) + " |"


def draw(folders):
    """The four variants of Figs. 10 and 11 at PICTURE_AT, from their previews."""
    gap = 4
    sheet = Image.new("RGB", (2 * TILE[0] + gap, 2 * TILE[1] + gap), "white")
    font = ImageFont.truetype("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", 20)
    for k, name in enumerate(PICTURES):
        folder = os.path.join(folders[name], "preview")
        number = int(np.argmin(np.abs(Run(folders[name]).times - PICTURE_AT)))
        preview = Image.open(os.path.join(folder, f"{number:06d}.png")).convert("RGB")
        tile = preview.crop((LEFT, TOP, LEFT + TILE[0], TOP + TILE[1]))
        pen = ImageDraw.Draw(tile)
        pen.text((TILE[0] - 10, 10), SCENES[name][0], fill="white", font=font, anchor="ra")
        sheet.paste(tile, ((k % 2) * (TILE[0] + gap), (k // 2) * (TILE[1] + gap)))
    sheet.save(os.path.join(ROOT, "docs", "pictures", "ablations.png"), optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spindrift", default=os.path.join(ROOT, "build", "release", "spindrift"), metavar="PATH",
                        help="the program (default: build/release/spindrift)")
    parser.add_argument("--out", default=os.path.join(ROOT, "runs", "ablations"), metavar="DIR",
                        help="where the run folders go (default: runs/ablations)")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="runs at the same time (default: 1)")
    arguments = parser.parse_args()
    runs = [(name, seed) for name, (_, _, seeds, _) in SCENES.items() for seed in seeds]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        folders = list(pool.map(lambda run: execute(arguments.spindrift, arguments.out, *run), runs))
    print("| scene | seed | dense particles | front [m] | fastest front [m/s] | cloud [m] | smoke [kg/m] | outline |\n"
          "| --- | --- | --- | --- | --- | --- | --- | --- |")
    for (name, seed), folder in zip(runs, folders):
        print(row(name, seed, folder))
    draw({name: folder for (name, seed), folder in zip(runs, folders) if seed == 1})


if __name__ == "__main__":
    main()
