# SPDX-License-Identifier: Apache-2.0
"""The path tracing benchmark's scenes in Cycles, run by a Python that has PyPI's bpy: pathCycles.py FOLDER [guided]"""
import os
import sys
import tempfile
import time

import bpy
import mathutils
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import pathWorker  # noqa: E402

Y_UP = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], float)  # row vectors, y up -> z up


def nodes_of(tree):
    tree.use_nodes = True
    tree.node_tree.nodes.clear()
    return tree.node_tree.nodes, tree.node_tree.links


def material(name, given):
    made = bpy.data.materials.new(name)
    nodes, links = nodes_of(made)
    output = nodes.new("ShaderNodeOutputMaterial")
    if "glass" in given:
        surface = nodes.new("ShaderNodeBsdfGlass")
        surface.distribution = "GGX"
        surface.inputs["Roughness"].default_value = given["roughness"]
        surface.inputs["IOR"].default_value = given["glass"]
    else:
        surface = nodes.new("ShaderNodeBsdfPrincipled")
        surface.distribution = "GGX"
        surface.inputs["Base Color"].default_value = (*given["color"], 1.0)
        surface.inputs["Roughness"].default_value = given["roughness"]
        surface.inputs["Metallic"].default_value = given["metallic"]
        if given["image"]:
            image = nodes.new("ShaderNodeTexImage")
            image.image = bpy.data.images.load(given["image"])
            links.new(image.outputs["Color"], surface.inputs["Base Color"])
    links.new(surface.outputs[0], output.inputs["Surface"])
    return made


def mesh(name, held, arrays, materials):
    made, i = bpy.data.meshes.new(name), held["number"]
    points = arrays[f"points{i}"] @ Y_UP[:3, :3]
    triangles = arrays[f"triangles{i}"]
    made.from_pydata(points.tolist(), [], triangles.tolist())
    made.materials.append(materials[held["material"]])
    made.polygons.foreach_set("use_smooth", [held["smooth"]] * len(triangles))
    if held["uv"]:
        made.uv_layers.new().data.foreach_set("uv", arrays[f"uv{i}"][triangles.ravel()].ravel())
    made.update()
    return made


def placed(name, data, rows):
    """:param rows: 4 x 4 row vectors in the scene's own axes"""
    made = bpy.data.objects.new(name, data)
    made.matrix_world = mathutils.Matrix((np.linalg.inv(Y_UP) @ np.asarray(rows, float) @ Y_UP).T.tolist())
    bpy.context.scene.collection.objects.link(made)
    return made


def looking(name, data, rows):
    """Cameras and lights look along their own -z in both."""
    made = bpy.data.objects.new(name, data)
    made.matrix_world = mathutils.Matrix((np.asarray(rows, float) @ Y_UP).T.tolist())
    bpy.context.scene.collection.objects.link(made)
    return made


def facing(origin, target):
    origin, target = np.asarray(origin, float), np.asarray(target, float)
    z = (origin - target) / np.linalg.norm(origin - target)
    x = np.cross([0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    rows = np.eye(4)
    rows[:3, :3], rows[3, :3] = (x, np.cross(z, x), z), origin
    return rows


def sky(path):
    """A quarter of a turn lies between the two ways to map a sky."""
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    nodes, links = nodes_of(world)
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(path)
    turn = nodes.new("ShaderNodeMapping")
    turn.inputs["Rotation"].default_value[2] = np.pi / 2
    place = nodes.new("ShaderNodeTexCoord")
    light, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    links.new(place.outputs["Generated"], turn.inputs["Vector"])
    links.new(turn.outputs["Vector"], image.inputs["Vector"])
    links.new(image.outputs["Color"], light.inputs["Color"])
    links.new(light.outputs[0], output.inputs["Surface"])


def main(folder, guided=""):
    started = time.perf_counter()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    held, arrays = pathWorker.load(folder)
    materials = {name: material(name, given) for name, given in held["materials"].items()}
    for name, own in held["meshes"].items():
        data, places = mesh(name, own, arrays, materials), f"instances{own['number']}"
        for k, place in enumerate(arrays[places] if places in arrays else [np.eye(4)]):
            placed(f"{name}{k}", data, place)
    for i, (place, width, height, radiance) in enumerate(held["rects"]):
        light = bpy.data.lights.new(f"rect{i}", "AREA")
        light.shape, light.size, light.size_y = "RECTANGLE", width, height
        light.energy = radiance * width * height * np.pi  # watts: a Lambertian emitter's radiance times area times pi
        looking(f"rect{i}", light, place)
    if held["sky"]:
        sky(held["sky"])
    eye, target, view = held["camera"]
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.angle = "HORIZONTAL", np.radians(view)
    scene = bpy.context.scene
    scene.camera = looking("camera", camera, facing(eye, target))
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = held["width"], held["height"]
    scene.render.resolution_percentage = 100
    scene.render.use_persistent_data = True
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    if held["threads"]:
        scene.render.threads_mode, scene.render.threads = "FIXED", held["threads"]
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.device, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", False, False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = held["depth"]
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    width = 2.0 * held.get("filter", 0.5)  # of a Gaussian, four standard deviations
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN" if width > 1.0 else "BOX", width
    cycles.use_light_tree, cycles.use_guiding = True, bool(guided)
    file = os.path.join(tempfile.mkdtemp(prefix="pathCycles"), "image.exr")

    def draw(samples, seed, to, plain):
        cycles.samples, cycles.seed = samples, seed
        cycles.use_denoising = bool(held.get("denoise") and not plain)
        cycles.blur_glossy = 1.0 if held.get("blur") and not plain else 0.0
        scene.render.filepath = file
        bpy.ops.render.render(write_still=True)
        if to == os.devnull:
            return
        image = bpy.data.images.load(file, check_existing=False)
        image.colorspace_settings.name = "Non-Color"
        pixels = np.empty(held["width"] * held["height"] * 4, np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        np.save(to, pixels.reshape(held["height"], held["width"], 4)[::-1, :, :3])

    pathWorker.serve(draw, started, bpy.app.version_string)


main(*sys.argv[1:])
