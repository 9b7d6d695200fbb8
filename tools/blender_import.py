"""Shows an exported run in Blender, animated: snow as small spheres, smoke as a haze of larger, see-through ones.

    spindrift export RUN --to ply
    blender -P tools/blender_import.py -- RUN/export                       # opens Blender with the run
    blender -b -P tools/blender_import.py -- RUN/export --save run.blend   # without a window: a file to open later
    blender -b -P tools/blender_import.py -- RUN/export --render out.png --frame 40
    blender -b -P tools/blender_import.py -- RUN/export --film out.mp4     # every frame

Options: --fps N (film frames per second, 10), --smoke D (density that hides two thirds over a metre, 2 kg/m^3),
--width W (pixels of a picture, 1280), --samples N (Cycles samples a pixel, 32), --save, --render, --film as above.
Needs Blender 3.1 or newer and nothing else; tried with 3.4. Every PLY file becomes a mesh of points on its own frame of
the timeline, with the arrays of the run as attributes: "velocity" [m/s], "mass_density" [kg/m^3], "half_edge" [m], ...
A run in two dimensions lies in the plane y = 0; z is up.
"""

import argparse
import math
import pathlib
import re
import sys

import bpy
import numpy as np
from mathutils import Vector

PLY_TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4"}
# Blender has its own use for these names: the density of a volume, the radius of a drawn point.
RENAMED = {"density": "mass_density", "radius": "half_edge"}
SNOW, COVER, SMOKE = (0.85, 0.90, 1.0, 1.0), (0.45, 0.60, 0.80, 1.0), (0.95, 0.97, 1.0, 1.0)


def read_ply(path):
    """The vertices of a PLY file as `spindrift export --to ply` writes it: a numpy array of named columns."""
    content = path.read_bytes()
    head, found, body = content.partition(b"end_header\n")
    if not found or not head.startswith(b"ply\nformat binary_little_endian 1.0\n"):
        raise ValueError(f"{path}: expected a binary PLY file of `spindrift export --to ply`")
    lines = head.decode().split("\n")
    columns = [line.split()[1:] for line in lines if line.startswith("property ")]
    return np.frombuffer(body, dtype=[(name, PLY_TYPES[kind]) for kind, name in columns])


def vectors(table, names):
    return np.stack([table[name].astype(np.float32) for name in names], axis=1)


def point_mesh(name, table):
    """A mesh of vertices alone, with the columns as attributes: "velocity" a vector, the others numbers."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(table))
    mesh.vertices.foreach_set("co", vectors(table, "xyz").ravel())
    columns = [n for n in table.dtype.names if n not in ("x", "y", "z") and not n.startswith("velocity_")]
    for column in columns:
        whole = table.dtype[column].kind == "i"  # Blender wants an "id" to be whole
        attribute = mesh.attributes.new(RENAMED.get(column, column), "INT" if whole else "FLOAT", "POINT")
        attribute.data.foreach_set("value", table[column].astype(np.int32 if whole else np.float32))
    if "velocity_x" in table.dtype.names:
        attribute = mesh.attributes.new("velocity", "FLOAT_VECTOR", "POINT")
        attribute.data.foreach_set("vector", vectors(table, ("velocity_x", "velocity_y", "velocity_z")).ravel())
    mesh.update()
    return mesh


def snow_material():
    """White-blue where the layer is 0, darker where it is 1, the cover."""
    material = bpy.data.materials.new("snow")
    material.use_nodes = True
    tree = material.node_tree
    layer = tree.nodes.new("ShaderNodeAttribute")
    layer.attribute_name = "layer"
    mix = tree.nodes.new("ShaderNodeMixRGB")
    mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = SNOW, COVER
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.9
    tree.links.new(layer.outputs["Fac"], mix.inputs["Fac"])
    tree.links.new(mix.outputs["Color"], shader.inputs["Base Color"])
    return material


def smoke_material(hiding_density):
    """See-through: alpha = 1 - exp(-density / hiding_density * edge of the cell), as far as spheres overlap."""
    material = bpy.data.materials.new("smoke")
    material.use_nodes = True
    material.blend_method = "BLEND"
    tree = material.node_tree

    def value(name):
        attribute = tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = name
        return attribute.outputs["Fac"]

    def math_node(operation, first, second):
        made = tree.nodes.new("ShaderNodeMath")
        made.operation = operation
        for socket, given in zip(made.inputs, (first, second)):
            if isinstance(given, (int, float)):
                socket.default_value = given
            else:
                tree.links.new(given, socket)
        return made.outputs["Value"]

    depth = math_node("MULTIPLY", math_node("MULTIPLY", value("mass_density"), value("half_edge")), -2.0 / hiding_density)
    alpha = math_node("SUBTRACT", 1.0, math_node("POWER", math.e, depth))
    # A ray meets the front and the back of a sphere: each hides the half. The haze shines by itself, since the shadows
    # of spheres on spheres would show the grid.
    half = math_node("SUBTRACT", 1.0, math_node("SQRT", math_node("SUBTRACT", 1.0, alpha), 0.0))
    clear, haze = tree.nodes.new("ShaderNodeBsdfTransparent"), tree.nodes.new("ShaderNodeEmission")
    haze.inputs["Color"].default_value = SMOKE
    mix = tree.nodes.new("ShaderNodeMixShader")
    for socket, given in zip(mix.inputs, (half, clear.outputs[0], haze.outputs[0])):
        tree.links.new(given, socket)
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    return material


def sphere_modifier(name, material, growth):
    """Geometry nodes that show each vertex as a sphere of `growth` times its half edge."""
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    if hasattr(tree, "interface"):  # Blender 4
        for way in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    points = tree.nodes.new("GeometryNodeMeshToPoints")
    radius = tree.nodes.new("GeometryNodeInputNamedAttribute")
    radius.data_type = "FLOAT"
    radius.inputs["Name"].default_value = "half_edge"
    scale = tree.nodes.new("ShaderNodeMath")
    scale.operation = "MULTIPLY"
    scale.inputs[1].default_value = growth
    paint = tree.nodes.new("GeometryNodeSetMaterial")
    paint.inputs["Material"].default_value = material
    tree.links.new(start.outputs[0], points.inputs["Mesh"])
    tree.links.new(next(o for o in radius.outputs if o.enabled), scale.inputs[0])
    tree.links.new(scale.outputs[0], points.inputs["Radius"])
    tree.links.new(points.outputs[0], paint.inputs["Geometry"])
    tree.links.new(paint.outputs[0], end.inputs[0])
    return tree


def show_only_on(item, frame, last):
    """Keys that show an object on one frame of the timeline; the last one stays."""
    for hidden, at in ((True, frame - 1), (False, frame), (True, frame + 1)):
        if (at > last) or (hidden and at < 0):
            continue
        item.hide_viewport = item.hide_render = hidden
        item.keyframe_insert("hide_viewport", frame=at)
        item.keyframe_insert("hide_render", frame=at)
    for curve in item.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "CONSTANT"


def import_layer(folder, layer, tree, numbers):
    """All frames of a layer as objects of a collection. Returns the corners of the box they fill."""
    collection = bpy.data.collections.new(layer)
    bpy.context.scene.collection.children.link(collection)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for place, number in enumerate(numbers):
        path = folder / f"{layer}_{number:06}.ply"
        if not path.is_file():
            continue
        table = read_ply(path)
        item = bpy.data.objects.new(path.stem, point_mesh(path.stem, table))
        item.modifiers.new("spheres", "NODES").node_group = tree
        collection.objects.link(item)
        show_only_on(item, place, len(numbers) - 1)
        if len(table):
            positions = vectors(table, "xyz")
            low, high = np.minimum(low, positions.min(axis=0)), np.maximum(high, positions.max(axis=0))
    return low, high


def look_at(low, high, width):
    """An orthographic camera from the side that sees the whole box, a sun and a sky."""
    scene = bpy.context.scene
    centre, size = (low + high) / 2, np.maximum(high - low, 1e-3)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 1.06 * size[0]
    distance = 2 * float(size.max()) + 10
    camera.data.clip_end = 4 * distance
    camera.location = Vector((centre[0], low[1] - distance, centre[2]))
    camera.rotation_euler = (math.radians(90), 0, 0)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 3
    sun.rotation_euler = (math.radians(50), math.radians(-25), 0)
    for item in (camera, sun):
        scene.collection.objects.link(item)
    scene.camera = camera
    world = scene.world or bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.10, 0.22, 0.45, 1)
    height = width * max(0.25, 1.1 * size[2] / size[0])
    scene.render.resolution_x, scene.render.resolution_y = (2 * max(1, round(n / 2)) for n in (width, height))
    scene.render.resolution_percentage = 100


def use_cycles(samples):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_denoising = False
    scene.cycles.transparent_max_bounces = 64
    scene.view_settings.view_transform = "Standard"


def frame_numbers(folder):
    names = (re.fullmatch(r"(?:particles|smoke)_([0-9]{6,})[.]ply", path.name) for path in folder.glob("*.ply"))
    return sorted({int(name[1]) for name in names if name})


def arguments():
    parser = argparse.ArgumentParser(prog="blender -P blender_import.py --", description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=pathlib.Path, help="folder with the PLY files of `spindrift export --to ply`")
    parser.add_argument("--fps", type=int, default=10, help="frames of the film a second (%(default)s)")
    parser.add_argument("--smoke", type=float, default=2, metavar="DENSITY", help="hides two thirds over a metre")
    parser.add_argument("--width", type=int, default=1280, help="pixels of a picture (%(default)s)")
    parser.add_argument("--samples", type=int, default=32, help="of Cycles, a pixel (%(default)s)")
    parser.add_argument("--frame", type=int, help="number of the run's frame to show (the last)")
    parser.add_argument("--save", type=pathlib.Path, metavar="FILE.blend")
    parser.add_argument("--render", type=pathlib.Path, metavar="FILE.png")
    parser.add_argument("--film", type=pathlib.Path, metavar="FILE.mp4")
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    return parser.parse_args(words)


def main():
    options = arguments()
    numbers = frame_numbers(options.folder)
    if not numbers:
        sys.exit(f"{options.folder}: no PLY files, expected those of `spindrift export RUN --to ply`")
    if options.frame is not None and options.frame not in numbers:
        sys.exit(f"{options.folder}: there is no frame {options.frame}")
    for item in list(bpy.data.objects):  # the cube of a new file
        bpy.data.objects.remove(item)

    # Spheres of smoke reach over their neighbours, so that the cells do not show.
    snow = import_layer(options.folder, "particles", sphere_modifier("snow", snow_material(), 1.0), numbers)
    smoke = import_layer(options.folder, "smoke", sphere_modifier("smoke", smoke_material(options.smoke), 2.0), numbers)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 0, len(numbers) - 1
    scene.render.fps = options.fps
    look_at(np.minimum(snow[0], smoke[0]), np.maximum(snow[1], smoke[1]), options.width)
    use_cycles(options.samples)
    scene.frame_set(numbers.index(options.frame) if options.frame is not None else len(numbers) - 1)

    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(options.save.resolve()))
    if options.render:
        scene.render.filepath = str(options.render.resolve())
        bpy.ops.render.render(write_still=True)
    if options.film:
        scene.render.image_settings.file_format = "FFMPEG"
        scene.render.ffmpeg.format = "MPEG4"
        scene.render.ffmpeg.codec = "H264"
        scene.render.filepath = str(options.film.resolve())
        bpy.ops.render.render(animation=True)
    print(f"{len(numbers)} frames of {options.folder}")


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError) as problem:
        sys.exit(str(problem))
