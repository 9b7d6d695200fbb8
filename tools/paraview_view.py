"""Draws a run folder with ParaView: snow as spheres coloured by speed, smoke as a white haze (in 3D a volume).

    pvpython tools/paraview_view.py RUN                        # RUN/paraview.png, the last frame
    pvpython tools/paraview_view.py RUN -o out.png --frame 40
    pvpython tools/paraview_view.py RUN -o film/%.png --all    # every frame: film/000000.png, ...

Options: --width W (pixels, 1400), --state FILE.pvsm (saves what is shown, to go on in ParaView: File > Load State).
Needs ParaView 5.10 or newer, whose pvpython knows `paraview.simple`; tried with 5.11. On a machine without a screen,
put `xvfb-run -a` before it.
"""

import argparse
import json
import pathlib
import sys

from paraview import simple as pv

CLOUD = 1e-3  # [kg/m^3], the thinnest smoke that is drawn
OPAQUE = 2.0  # [kg/m^3], as good as opaque
COVER, GROUND = [0.62, 0.74, 0.85], [0.55, 0.50, 0.44]


def arguments():
    parser = argparse.ArgumentParser(description="Draw a run folder of Spindrift with ParaView.")
    parser.add_argument("run", type=pathlib.Path, metavar="RUN")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="OUT.png")
    parser.add_argument("--frame", type=int, default=-1, help="place in the series, -1: the last")
    parser.add_argument("--all", action="store_true", help="every frame; %% in OUT becomes its number")
    parser.add_argument("--width", type=int, default=1400, help="pixels (%(default)s)")
    parser.add_argument("--state", type=pathlib.Path, metavar="FILE.pvsm")
    return parser.parse_args()


def part_of(source, array, low, high):
    """The points whose value of an array lies within bounds."""
    part = pv.Threshold(Input=source, Scalars=["POINTS", array])
    part.LowerThreshold, part.UpperThreshold = low, high  # afterwards: with the array ParaView chooses bounds of its own
    return part


def show_particles(view, source, dim):
    data = source.GetPointDataInformation()
    edge = (data["mass"].GetRange()[1] / data["density"].GetRange()[1]) ** (1 / dim)
    flow = pv.Show(part_of(source, "layer", 0, 0), view)
    parts = [flow]
    if data["layer"].GetRange()[1] == 1:
        cover = pv.Show(part_of(source, "layer", 1, 1), view)
        pv.ColorBy(cover, ("POINTS", "layer"))
        pv.GetColorTransferFunction("layer").RGBPoints = [0, *COVER, 1, *COVER]
        cover.SetScalarBarVisibility(view, False)
        parts.append(cover)
    for shown in parts:
        shown.SetRepresentationType("Point Gaussian")
        shown.GaussianRadius = edge / 2
        shown.ShaderPreset = "Plain circle" if dim == 2 else "Sphere"
    pv.ColorBy(flow, ("POINTS", "velocity", "Magnitude"))
    flow.RescaleTransferFunctionToDataRangeOverTime()
    speeds = pv.GetColorTransferFunction("velocity")
    speeds.ApplyPreset("Inferno (matplotlib)", True)
    bar = pv.GetScalarBar(speeds, view)
    bar.Title, bar.ComponentTitle = "speed of the flow, m/s", ""
    bar.Orientation, bar.WindowLocation, bar.ScalarBarLength = "Horizontal", "Upper Center", 0.3
    bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.3g", "%.3g"
    flow.SetScalarBarVisibility(view, True)


def show_smoke(view, source, dim):
    """Smoke white and the more opaque the denser, and the ground where the grid knows it."""
    colours, opacity = pv.GetColorTransferFunction("density"), pv.GetOpacityTransferFunction("density")
    colours.RGBPoints = [0, 1, 1, 1, OPAQUE, 1, 1, 1]
    opacity.Points = [0, 0, 0.5, 0, 0.1 * OPAQUE, 0.6, 0.5, 0, OPAQUE, 0.95, 0.5, 0]
    if dim == 3:
        shown = pv.Show(source, view)
        shown.SetRepresentationType("Volume")
    else:
        # Between the two equal layers that a frame of two dimensions holds.
        source = pv.Slice(Input=source, SliceType="Plane")
        source.SliceType.Origin, source.SliceType.Normal = [0, 0.5, 0], [0, 1, 0]
        colours.EnableOpacityMapping = 1
        shown = pv.Show(part_of(source, "density", CLOUD, 1e9), view)
        shown.SetRepresentationType("Surface")
    pv.ColorBy(shown, ("POINTS", "density"))
    shown.SetScalarBarVisibility(view, False)
    ground = pv.Show(part_of(source, "solid", 1, 1), view)
    ground.ColorArrayName = [None, ""]
    ground.DiffuseColor = ground.AmbientColor = GROUND


def look_from_the_side(view, sources, dim, width):
    """In 2D straight at the plane, in 3D from a little above. Returns the size of the picture in pixels."""
    bounds = [source.GetDataInformation().GetBounds() for source in sources]
    low = [min(b[2 * k] for b in bounds) for k in range(3)]
    high = [max(b[2 * k + 1] for b in bounds) for k in range(3)]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    size = [max(b - a, 1e-3) for a, b in zip(low, high)]
    view.CameraFocalPoint = centre
    view.CameraViewUp = [0, 0, 1]
    view.CameraPosition = [centre[0], centre[1] - 2 * max(size), centre[2] + (0 if dim == 2 else 0.7 * max(size))]
    ratio = min(max(size[2] / size[0], 0.3), 1.0) if dim == 2 else 0.6
    view.ViewSize = [width, round(width * ratio)]
    if dim == 2:
        view.CameraParallelProjection = 1
        view.CameraParallelScale = 0.52 * max(size[2], ratio * size[0])
    else:
        view.ResetCamera()
        view.GetActiveCamera().Zoom(1.5)
    return view.ViewSize


def main():
    options = arguments()
    if not (options.run / "run.json").is_file():
        sys.exit(f"{options.run}: not a run folder, it has no run.json")
    dim = json.loads((options.run / "run.json").read_text())["dim"]
    show = {"smoke": show_smoke, "particles": show_particles}
    series = {layer: options.run / f"{layer}.hdf.series" for layer in show}
    sources = {layer: pv.OpenDataFile(str(path.resolve())) for layer, path in series.items() if path.is_file()}
    if not sources:
        sys.exit(f"{options.run}: has no frames, expected particles.hdf.series or smoke.hdf.series")

    view = pv.CreateView("RenderView")
    pv.AssignViewToLayout(view, pv.CreateLayout(options.run.resolve().name))
    view.UseColorPaletteForBackground = 0
    view.Background = [0.32, 0.45, 0.62]
    view.OrientationAxesVisibility = 0
    scene = pv.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    times = sorted({time for source in sources.values() for time in source.TimestepValues})
    scene.AnimationTime = view.ViewTime = times[options.frame]
    for layer, source in sources.items():
        source.UpdatePipeline(times[options.frame])
        show[layer](view, source, dim)
    resolution = look_from_the_side(view, sources.values(), dim, options.width)

    for number in range(len(times)) if options.all else [options.frame]:
        scene.AnimationTime = view.ViewTime = times[number]
        output = options.output or options.run / "paraview.png"
        if options.all:
            output = pathlib.Path(str(output).replace("%", f"{number:06}"))
            output.parent.mkdir(parents=True, exist_ok=True)
        pv.SaveScreenshot(str(output), view, ImageResolution=resolution)
        print(output)
    if options.state:
        pv.SaveState(str(options.state))


if __name__ == "__main__":
    main()
