"""Draws a run folder of Spindrift on one page: the fields of a frame, and what happened over time.

    python3 tools/plot_run.py runs/quickstart [-o OUT.png] [--frame N]

Needs numpy, h5py and matplotlib. Panels of layers that the run does not have are left out.
"""

import argparse
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")  # a file, no window
    import matplotlib.pyplot as plt
    import numpy as np
    from matplotlib.colors import LogNorm

    from spindrift_reader import Run
except ModuleNotFoundError as missing:
    sys.exit(f"{missing}; ./dev extras installs it for Debian's /usr/bin/python3")

CLOUD = 1e-3  # [kg/m^3], the thinnest smoke that is drawn
GROUND = "#b5a58f"


def arguments():
    parser = argparse.ArgumentParser(description="Draw a run folder of Spindrift on one page.")
    parser.add_argument("run", metavar="RUN", help="run folder")
    parser.add_argument("-o", "--output", metavar="OUT.png", help="picture to write, .png, .pdf or .svg (RUN/plot.png)")
    parser.add_argument("--frame", type=int, metavar="N", help="frame to draw (the middle one); -1: the last")
    return parser.parse_args()


def fields_of(run, number):
    """The frame's particles and smoke, either of them None where the frame has none."""
    have = {layer: number in run.frames(layer) for layer in ("particles", "smoke")}
    snow = run.particles(number) if have["particles"] else None
    cloud = run.smoke(number) if have["smoke"] else None
    return (snow if snow is not None and len(snow["id"]) else None), cloud


def side_view(cloud):
    """A cloud seen from the side, (nx, nz): in 3D the densest smoke and the fastest air across, ground at the middle."""
    speed = np.linalg.norm(cloud["velocity"], axis=-1)
    if cloud["density"].ndim == 2:
        return cloud["density"], speed, cloud["solid"]
    middle = cloud["solid"].shape[1] // 2
    return cloud["density"].max(axis=1), speed.max(axis=1), cloud["solid"][:, middle]


def extent_of(cloud):
    """[left, right, bottom, top] of the grid's box [m]."""
    low = cloud["origin"] - cloud["spacing"] / 2
    high = low + cloud["spacing"] * np.array(cloud["density"].shape)
    return [low[0], high[0], low[-1], high[-1]]


def window_of(snow, cloud):
    """[left, right, bottom, top] of the pictures [m]: what moves, with some room around it, within the grid's box."""
    points = []
    if snow is not None:
        flows = snow["layer"] == 0
        points.append(snow["position"][flows if flows.any() else slice(None)][:, [0, -1]])
    if cloud is not None:
        cells = np.argwhere(side_view(cloud)[0] >= CLOUD)
        points.append(cloud["origin"][[0, -1]] + cells * cloud["spacing"][[0, -1]])
    points = np.concatenate(points)
    if len(points) == 0:
        return extent_of(cloud)
    low, high = points.min(axis=0), points.max(axis=0)
    room = 0.12 * max(*(high - low), 1e-2)
    low, high = low - room, high + room
    # No thin strips: at least a third as high as wide, and the other way round.
    for k in (0, 1):
        lacks = (high - low)[1 - k] / 3 - (high - low)[k]
        if lacks > 0:
            low[k], high[k] = low[k] - lacks / 2, high[k] + lacks / 2
    if cloud is not None:
        left, right, bottom, top = extent_of(cloud)
        low, high = np.maximum(low, [left, bottom]), np.minimum(high, [right, top])
    return [low[0], high[0], low[1], high[1]]


def draw_ground(axes, cloud):
    solid, extent = side_view(cloud)[2], extent_of(cloud)
    picture = np.ma.masked_where(~solid.T, np.ones(solid.T.shape))
    axes.imshow(picture, origin="lower", extent=extent, cmap=matplotlib.colors.ListedColormap([GROUND]), zorder=0)


def draw_grid(axes, values, mask, cloud, label, **options):
    values = np.ma.masked_where(mask, values).T
    add_bar(axes, axes.imshow(values, origin="lower", extent=extent_of(cloud), zorder=1, **options), label)


def add_bar(axes, image, label):
    """A colour bar as high as its picture."""
    axes.figure.colorbar(image, cax=axes.inset_axes([1.02, 0, 0.03, 1]), label=label)


def draw_snow(axes, snow, cloud, dim, window):
    x, z = snow["position"][:, 0], snow["position"][:, -1]
    speed = np.linalg.norm(snow["velocity"], axis=1)
    flows = np.flatnonzero(snow["layer"] == 0)
    flows = flows[np.argsort(speed[flows], kind="stable")]
    cover = snow["layer"] == 1
    # A dot is as large as its particle, but can be seen.
    size = float(np.median((snow["mass"] / snow["density"]) ** (1 / dim)))
    width = axes.get_window_extent().width / axes.figure.dpi * 72
    area = np.clip(size / (window[1] - window[0]) * width, 1.2, 6.0) ** 2
    axes.scatter(x[cover], z[cover], s=area, c="#a9bfd3", linewidths=0, zorder=1, label="cover")
    dots = axes.scatter(x[flows], z[flows], s=area, c=speed[flows], cmap="plasma", linewidths=0, vmin=0, zorder=2)
    add_bar(axes, dots, "speed of the flow [m/s]")
    if cover.any():
        axes.legend(loc="upper right", fontsize=8, markerscale=3)


def draw_smoke(axes, snow, cloud, dim, window):
    density = side_view(cloud)[0]
    norm = LogNorm(CLOUD, max(float(density.max()), 100 * CLOUD))
    draw_grid(axes, density, density < CLOUD, cloud, "density of smoke [kg/m³]", cmap="Blues", norm=norm)


def draw_air(axes, snow, cloud, dim, window):
    speed, solid = side_view(cloud)[1:]
    draw_grid(axes, speed, solid, cloud, "speed of the air [m/s]", cmap="viridis", vmin=0)


def draw_fields(figure, run, snow, cloud, window):
    """The panels of a frame in one row."""
    pictures = {"snow": draw_snow} if snow is not None else {}
    if cloud is not None:
        pictures.update({"smoke": draw_smoke, "air": draw_air})
    if run.dim == 3 and cloud is not None:
        pictures = {f"{title}, from the side": draw for title, draw in pictures.items()}
    row = figure.subplots(1, len(pictures), squeeze=False, sharey=True)[0]
    for axes, (title, draw_field) in zip(row, pictures.items()):
        axes.set(title=title, aspect="equal", xlim=window[:2], ylim=window[2:], xlabel="x [m]", facecolor="#f6f8fa")
        if cloud is not None:
            draw_ground(axes, cloud)
        draw_field(axes, snow, cloud, run.dim, window)
    row[0].set_ylabel("z [m]")


def lines(axes, time, table, entries):
    """The columns of `entries`, {label: name}, that are not zero all along. Returns how many there were."""
    drawn = 0
    for label, name in entries.items():
        if np.any(table[name] != 0):
            axes.plot(time, table[name], label=label, linewidth=1.3)
            drawn += 1
    return drawn


def legend(axes):
    """A small legend where it covers least; a word where there is nothing to tell."""
    if not axes.get_legend_handles_labels()[0]:
        axes.text(0.5, 0.5, "zero throughout", transform=axes.transAxes, ha="center", color="gray")
        return
    axes.legend(fontsize=7.5, framealpha=0.7, borderpad=0.3, labelspacing=0.25, handlelength=1.4)


def draw_front(axes, time, table, run):
    axes.plot(time, table["front_m"], color="#1f77b4")
    axes.set(title="front", ylabel="along the ground [m]")


def draw_speed(axes, time, table, run):
    axes.plot(time, table["front_speed_m_s"], color="#d62728")
    axes.set(title="speed of the front", ylabel="[m/s]")


def draw_cloud(axes, time, table, run):
    axes.plot(time, table["cloud_height_m"], color="#2ca02c")
    axes.set(title="height of the cloud", ylabel="above ground [m]", ylim=(0, None))


def draw_masses(axes, time, table, run):
    names = ("dense", "cover", "smoke", "injected", "outflow", "deposited")
    drawn = lines(axes, time, table, {"dense flow" if n == "dense" else n: f"mass_{n}_kg" for n in names})
    axes.set(title="mass by layer", ylabel="[kg/m of width]" if run.dim == 2 else "[kg]")
    if drawn > 1:
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set_ylim(max(low, 1e-5 * high), high)
    else:
        axes.set_ylim(0, None)
    legend(axes)


def draw_counts(axes, time, table, run):
    names = ("dense", "overlap", "entrained", "vanished", "outflow")
    lines(axes, time, table, {"dense flow" if n == "dense" else n: f"n_{n}" for n in names})
    axes.set(title="particles", ylabel="count", ylim=(0, None))
    legend(axes)


def draw_mass_error(axes, time, table, run):
    if np.any(table["mass_error"] != 0):
        axes.plot(time, table["mass_error"], color="#333333", linewidth=0.8)
        axes.ticklabel_format(axis="y", style="sci", scilimits=(0, 0))
    else:
        legend(axes)
    axes.set(title="ledger: mass error", ylabel="relative to the mass brought in")


def draw_sums(axes, time, table, entries, of, run):
    """What each entry, {label: name}, has given along x until then."""
    for label, name in entries.items():
        given = np.cumsum(table[name + "_x"])
        if np.any(given != 0):
            axes.plot(time, given, label=label, linewidth=1.3)
    axes.set(title=f"ledger: the {of}'s momentum along x", ylabel="[kg m/s per m]" if run.dim == 2 else "[kg m/s]")
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-3, 3))
    legend(axes)


def draw_flow_momentum(axes, time, table, run):
    entries = {
        "gravity": "gravity_on_dense",
        "walls": "boundary_on_dense",
        "bed friction": "bed_friction",
        "air": "exchange_on_particles",
        "air at the core": "core_reaction",
        "snow that left": "particle_outflow",
    }
    draw_sums(axes, time, table, entries, "flow", run)


def draw_air_momentum(axes, time, table, run):
    entries = {
        "flow": "exchange_on_grid",
        "flow's core": "air_core",
        "gravity on smoke": "gravity_on_smoke",
        "source of smoke": "smoke_source",
        "sinking cover": "ground_on_air",
        "advection": "air_advection",
        "smoke's transport": "air_smoke_transport",
        "diffusion": "air_diffusion",
        "confinement": "air_confinement",
        "pressure": "air_projection",
    }
    draw_sums(axes, time, table, entries, "air", run)


def draw_time_step(axes, time, table, run):
    limiters = list(dict.fromkeys(table["limiter"]))
    for k, limiter in enumerate(limiters):
        chosen = table["limiter"] == limiter
        share = f"{limiter.replace('_', ' ')} ({100 * chosen.mean():.0f} %)"
        axes.plot(time[chosen], 1e3 * table["dt_s"][chosen], ".", markersize=2.5, color=f"C{k}", label=share)
    axes.set(title="time step, and what limits it", ylabel="[ms]", ylim=(0, None))
    axes.legend(fontsize=7.5, framealpha=0.85, markerscale=4, borderpad=0.3, labelspacing=0.25, handlelength=1)


def panels_of(run, table):
    """The panels over time that this run has something for."""
    flow = np.any(table["n_dense"] > 0)
    cloud = run.info["grid_cells"] > 0
    return (
        ([draw_front, draw_speed] if flow else [])
        + ([draw_cloud] if cloud else [])
        + [draw_masses]
        + ([draw_counts] if flow else [])
        + [draw_time_step, draw_mass_error]
        + ([draw_flow_momentum] if flow else [])
        + ([draw_air_momentum] if cloud else [])
    )


def draw_history(figure, run, panels):
    table = run.diagnostics
    time = table["time_s"]
    n_columns = 3 if len(panels) in (5, 6, 9) else 4
    grid = figure.subplots(-(-len(panels) // n_columns), n_columns, squeeze=False).ravel()
    for axes, draw_panel in zip(grid, panels):
        draw_panel(axes, time, table, run)
        axes.set(xlabel="time [s]", xlim=(0, time[-1]))
        axes.grid(alpha=0.25)
    for axes in grid[len(panels) :]:
        axes.set_visible(False)


def chosen_frame(run, number):
    """The number of the frame to draw, None where the run has none. number: None: the one in the middle."""
    numbers = run.frames()
    if number is None:
        return numbers[len(numbers) // 2] if numbers else None
    if number < 0 and -number <= len(numbers):
        number = numbers[number]
    if number not in numbers:
        there = f"it has {numbers[0]} to {numbers[-1]}" if numbers else "it has none"
        raise IndexError(f"{run.folder}: there is no frame {number}, {there}")
    return number


def draw(run, number=None):
    """The page as a matplotlib figure. number: of the frame; None: the one in the middle."""
    number = chosen_frame(run, number)
    snow, cloud = fields_of(run, number) if number is not None else (None, None)
    panels = panels_of(run, run.diagnostics) if len(run.diagnostics["time_s"]) else []
    below = 2.9 * (3 if len(panels) > 8 else 2 if panels else 0)
    above, width = 0.0, 15.0
    if snow is not None or cloud is not None:
        window = window_of(snow, cloud)
        each = 0.75 * width / (3 if cloud is not None and snow is not None else 2)
        above = np.clip(each * (window[3] - window[2]) / (window[1] - window[0]), 1.5, 5.0) + 1.2

    figure = plt.figure(figsize=(width, above + below + 0.6), layout="constrained", dpi=110)
    info = run.info
    when = "" if number is None else f"   frame {number} at {run.times[run.frames().index(number)]:.3g} s"
    figure.suptitle(
        f"{info['scene']}   {run.dim}D, seed {info['seed']}, {info['status']} at {info['time']:.3g} s "
        f"after {info['steps']} steps{when}",
        fontsize=13,
    )
    parts = [part for part in (above, below) if part > 0]
    figures = list(figure.subfigures(len(parts), 1, height_ratios=parts, squeeze=False)[:, 0]) if parts else []
    if above > 0:
        draw_fields(figures.pop(0), run, snow, cloud, window)
    if below > 0:
        draw_history(figures.pop(0), run, panels)
    return figure


def main():
    options = arguments()
    try:
        run = Run(options.run)
        figure = draw(run, options.frame)
        output = pathlib.Path(options.output) if options.output else run.folder / "plot.png"
        figure.savefig(output)
    except (OSError, IndexError) as problem:
        sys.exit(str(problem))
    print(output)


if __name__ == "__main__":
    main()
