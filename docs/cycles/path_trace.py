"""Draws scenes with Cycles: path_trace.py OUT [NAME ...], in a Python that has bpy (see README.md).

For each OUT/NAME.json a picture, NAME.png, and NAME-mask.png, whose alpha is what hair covers with the body cut out.
"""

import json
import math
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

MASK_SAMPLES = 64


def draw(scene, out):
    """The picture of one scene and its mask, those of them that are not there."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    render = bpy.context.scene.render
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = scene["size"]
    cycles = bpy.context.scene.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", scene["samples"], scene.get("seed", 0)
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    settings = bpy.context.scene.view_settings
    settings.view_transform, settings.look = "Standard", "None"
    light(scene)
    bodies = [body(path, scene["skin_rgb"]) for path in scene["head"]]
    material = hair(scene)
    camera(scene)
    image = render.image_settings
    image.file_format, image.color_depth = "PNG", "16"
    save(out.with_suffix(".png"), image, "RGB")
    render.film_transparent = True
    cycles.samples, cycles.max_bounces = MASK_SAMPLES, 0
    for each in bodies:
        each.is_holdout = True
    nodes(material, "ShaderNodeEmission")
    save(out.with_name(f"{out.name}-mask.png"), image, "RGBA")


def save(path, image, mode):
    """Draw what there is into a file, if it is not there."""
    if not path.exists():
        image.color_mode = mode
        bpy.context.scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)


def link(name, data):
    """A new object in the scene."""
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    return made


def nodes(material, kind):
    """Give a material one shader, which is returned."""
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new(kind), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs[0])
    return shader


def light(scene):
    """An even sky and a sun."""
    world = bpy.context.scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (*[scene["ambient"]] * 3, 1)
    if scene["sun_strength"] > 0:
        lamp = bpy.data.lights.new("sun", "SUN")
        lamp.energy, lamp.angle = scene["sun_strength"], math.radians(0.526)
        sun = link("sun", lamp)
        sun.rotation_mode = "QUATERNION"
        sun.rotation_quaternion = Vector(scene["sun_direction"]).normalized().to_track_quat("Z", "Y")


def body(path, colour):
    """A smooth mesh with the standard material."""
    lines = [line.split() for line in Path(path).read_text(encoding="utf-8").splitlines()]
    vertices = [[float(x) for x in line[1:4]] for line in lines if line[:1] == ["v"]]
    faces = [[int(corner.split("/")[0]) - 1 for corner in line[1:]] for line in lines if line[:1] == ["f"]]
    mesh = bpy.data.meshes.new("body")
    mesh.from_pydata(vertices, [], faces)
    mesh.shade_smooth()
    material = bpy.data.materials.new("skin")
    skin = nodes(material, "ShaderNodeBsdfPrincipled")
    skin.inputs["Base Color"].default_value = (*colour, 1)
    skin.inputs["Roughness"].default_value = 0.5
    mesh.materials.append(material)
    return link("body", mesh)


def hair(scene):
    """Curves with the hair shader of Chiang et al.; returns their material."""
    strands = np.load(scene["strands"])
    points, counts = strands["points"].astype(np.float32), strands["counts"].astype(np.int32)
    curves = bpy.data.hair_curves.new("hair")
    curves.add_curves(counts.tolist())
    curves.points.foreach_set("position", points.ravel())
    first = np.cumsum(counts) - counts
    along = (np.arange(len(points)) - np.repeat(first, counts)) / np.repeat(counts - 1, counts)
    root, tip = scene["hair_radius_root"], scene["hair_radius_tip"]
    radius = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", (root + (tip - root) * along).astype(np.float32))
    material = bpy.data.materials.new("hair")
    shader = nodes(material, "ShaderNodeBsdfHairPrincipled")
    shader.model, shader.parametrization = "CHIANG", "MELANIN"
    given = {
        "Melanin": scene["hair_melanin"], "Melanin Redness": scene["hair_redness"],
        "Roughness": scene["hair_roughness"], "Radial Roughness": scene["hair_roughness"],
        "Random Color": 0.0, "Random Roughness": 0.0, "Coat": 0.0,
    }  # fmt: skip
    for name, value in given.items():
        shader.inputs[name].default_value = value
    curves.materials.append(material)
    link("hair", curves)
    return material


def camera(scene):
    """A camera as ``headstudio render --view`` has it, with +Y up."""
    lens = bpy.data.cameras.new("camera")
    lens.lens_unit, lens.angle, lens.clip_start = "FOV", math.radians(scene["fov_degrees"]), 0.01
    eye = Vector(scene["eye"])
    back = (eye - Vector(scene["target"])).normalized()
    right = Vector((0, 1, 0)).cross(back).normalized()
    placed = link("camera", lens)
    placed.matrix_world = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    placed.location = eye
    bpy.context.scene.camera = placed


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for path in sorted(folder.glob("*.json")):
        if len(sys.argv) == 2 or path.stem in sys.argv[2:]:
            draw(json.loads(path.read_text(encoding="utf-8")), path.with_suffix(""))
