# SPDX-License-Identifier: Apache-2.0
"""Runs in a Blender: installs the extension, makes a scene of its own, exports it and renders it with several engines.

  python blenderScene.py EXTENSION.zip FOLDER [ENGINE...] [SETTING=NUMBER...]

FOLDER gets scene.usda and ENGINE.exr of each engine (PATINA, CYCLES), and passes.npz with the passes of Patina by the names of
their channels. Settings are Patina's. VIEWPORT writes viewport.npz, see write_viewport()."""
import math
import os
import sys
import time

import bpy
import numpy as np

SIZE, FRAME = (160, 120), 2
SMOKE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes", "textures", "puff.vdb")


def material(name, **inputs):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    principled = made.node_tree.nodes["Principled BSDF"]
    for key, value in inputs.items():
        principled.inputs[key.replace("_", " ")].default_value = value
    return made


def textured(folder):
    """A checker that an image file holds."""
    image = bpy.data.images.new("checker", 64, 64)
    image.pixels[:] = [c for y in range(64) for x in range(64)
                       for c in ((0.8, 0.7, 0.2, 1.0) if (x // 8 + y // 8) % 2 else (0.1, 0.2, 0.5, 1.0))]
    image.filepath_raw, image.file_format = os.path.join(folder, "checker.png"), "PNG"
    image.save()
    made = material("textured", Roughness=0.6)
    node = made.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    made.node_tree.links.new(node.outputs["Color"], made.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
    return made


def materials(folder):
    return [
        material("matte", Base_Color=(0.6, 0.3, 0.2, 1), Roughness=1.0, Specular_IOR_Level=0.0),
        material("plastic", Base_Color=(0.1, 0.4, 0.7, 1), Roughness=0.3),
        material("gloss", Base_Color=(0.5, 0.05, 0.05, 1), Roughness=0.1),
        material("gold", Base_Color=(1.0, 0.77, 0.34, 1), Metallic=1.0, Roughness=0.25),
        material("steel", Base_Color=(0.6, 0.6, 0.62, 1), Metallic=1.0, Roughness=0.5),
        material("coated", Base_Color=(0.2, 0.5, 0.1, 1), Roughness=0.6, Coat_Weight=1.0, Coat_Roughness=0.05),
        material("glow", Base_Color=(0, 0, 0, 1), Emission_Color=(1, 0.6, 0.2, 1), Emission_Strength=0.8),
        material("half", Base_Color=(0.7, 0.7, 0.2, 1), Roughness=0.8, Alpha=0.5),
        material("grey", Base_Color=(0.18, 0.18, 0.18, 1), Roughness=0.8),
        material("white", Base_Color=(0.8, 0.8, 0.8, 1), Roughness=0.9),
        material("dark", Base_Color=(0.02, 0.02, 0.02, 1), Roughness=0.4),
        textured(folder),
    ]


def link(name, data, place=(0, 0, 0), turn=(0, 0, 0)):
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.rotation_euler = place, turn
    bpy.context.scene.collection.objects.link(thing)
    return thing


def light(name, kind, energy, place, turn=(0, 0, 0), **values):
    data = bpy.data.lights.new(name, kind)
    data.energy = energy
    for key, value in values.items():
        setattr(data, key, value)
    return link(name, data, place, turn)


def hair(look, place, radius):
    """A tuft on the upper half of a ball."""
    random = np.random.default_rng(3)
    roots = random.normal(size=(150, 3))
    roots /= np.linalg.norm(roots, axis=1, keepdims=True)
    roots[:, 2] = np.abs(roots[:, 2])
    lengths = np.linspace(1.0, 1.8, 5)[None, :, None]
    points = roots[:, None, :] * lengths + np.array([0.25, 0.0, -0.35]) * (lengths - 1.0) ** 2
    curves = bpy.data.hair_curves.new("tuft")
    curves.add_curves([points.shape[1]] * len(points))
    curves.points.foreach_set("position", (radius * points).astype(np.float32).ravel())
    widths = curves.attributes.new("radius", "FLOAT", "POINT")
    widths.data.foreach_set("value", np.full(points.shape[0] * points.shape[1], 0.008, np.float32))
    curves.materials.append(look)
    link("tuft", curves, place)


def smoke(place):
    volume = bpy.data.volumes.new("puff")
    volume.filepath = os.path.abspath(SMOKE)
    link("puff", volume, place).scale = (0.4, 0.4, 0.4)


def moving(camera):
    """It is somewhere else at each frame."""
    for frame, x in ((1, -1.5), (FRAME, 0.0)):
        camera.location[0] = x
        camera.keyframe_insert("location", frame=frame)
    bpy.context.scene.frame_end = FRAME


def make(folder):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.view_settings.view_transform = "Standard"
    looks = materials(folder)
    bpy.ops.mesh.primitive_plane_add(size=14, location=(0, 0, 0))
    bpy.context.object.data.materials.append(looks[9])
    for i, look in enumerate(looks):
        place = (-2.5 + (i % 6), -0.8 + 1.2 * (i // 6), 0.4)
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.4, location=place, segments=48, ring_count=24)
        bpy.ops.object.shade_smooth()
        bpy.context.object.data.materials.append(look)
    bpy.ops.mesh.primitive_cube_add(size=0.3, location=(0, 0, -20))  # out of sight, its instances are not
    seed = bpy.context.object
    seed.data.materials.append(looks[4])
    for i in range(5):
        link(f"copy{i}", seed.data, (-2 + i, 2.0, 0.15 + 0.1 * i), (0, 0, 0.3 * i))
    bpy.data.curves.new("bow", "CURVE")
    curve = bpy.data.curves["bow"]
    curve.dimensions, curve.bevel_depth = "3D", 1.0
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(2)
    for point, place in zip(spline.bezier_points, ((-3, 2.6, 0.1), (0, 2.6, 1.6), (3, 2.6, 0.1))):
        point.co, point.radius = place, 0.05  # the exporter writes widths of these alone
        point.handle_left_type = point.handle_right_type = "AUTO"
    curve.materials.append(looks[3])
    link("bow", curve)
    hair(looks[4], (3.2, -1.4, 0.3), 0.3)
    smoke((-2.6, -2.2, 0.6))
    light("sun", "SUN", 1.0, (0, 0, 5), (0.6, 0.2, 0))
    light("point", "POINT", 60, (-3, -3, 3), shadow_soft_size=0.3)
    light("spot", "SPOT", 200, (3, -3, 4), (0.75, 0, 0.75), spot_size=0.9, spot_blend=0.3, shadow_soft_size=0.2)
    light("square", "AREA", 60, (0, 3, 4), (-0.6, 0, 0), shape="SQUARE", size=1.0)
    light("disk", "AREA", 40, (-4, 0, 3), (0, -0.9, 0), shape="DISK", size=0.8)
    world = bpy.data.worlds.new("sky")
    scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.25, 0.3, 1)
    camera = bpy.data.cameras.new("camera")
    camera.lens = 35
    scene.camera = link("camera", camera, (0, -7.5, 4.2), (math.radians(62), 0, 0))
    moving(scene.camera)
    return scene


def install(file):
    bpy.ops.extensions.package_install_files(filepath=file, repo="user_default", enable_on_install=True)


def write_passes(scene, folder):
    """Renders again, with all passes that Patina has."""
    getattr(bpy.utils, "expose_bundled_modules", lambda: None)()
    import OpenImageIO

    layer, settings = bpy.context.view_layer, scene.render.image_settings
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = scene.patina.albedoPass = True
    if hasattr(settings, "media_type"):  # since Blender 5.0
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    scene.render.filepath = os.path.join(folder, "passes.exr")
    bpy.ops.render.render(write_still=True)
    file, found, part = OpenImageIO.ImageInput.open(scene.render.filepath), {}, 0
    while file.seek_subimage(part, 0):
        pixels = file.read_image(part, 0, 0, file.spec().nchannels, "float")
        found.update({name.split(".", 1)[-1]: pixels[..., i] for i, name in enumerate(file.spec().channelnames)})
        part += 1
    np.savez(os.path.join(folder, "passes.npz"), **found)


def write_viewport(scene, folder):
    """Draws what a viewport shows from the camera's place, until it changes no more: pixels (rows from the bottom), and the
    matrices that it looks by. A Blender without windows draws none, so the engine is asked within a render, which makes one."""
    import gpu
    from mathutils import Matrix

    gpu.init()
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    space, view = area.spaces.active, area.spaces.active.region_3d
    space.shading.type, space.lens = "RENDERED", scene.camera.data.lens
    view.view_perspective, view.view_matrix = "PERSP", scene.camera.matrix_world.inverted()
    view.update()
    width, height = region.width, region.height
    pixelwise = Matrix(((2 / width, 0, 0, -1), (0, 2 / height, 0, -1), (0, 0, -1, 0), (0, 0, 0, 1)))
    shown = [np.zeros(1)]

    def draw(engine, depsgraph):
        target = gpu.types.GPUOffScreen(width, height, format="RGBA32F")
        with bpy.context.temp_override(window=window, area=area, region=region, space_data=space):
            engine.view_update(bpy.context, depsgraph)
            same, end = 0, time.monotonic() + 300
            while same < 8 and time.monotonic() < end:
                time.sleep(0.25)
                with target.bind():
                    gpu.matrix.load_matrix(Matrix.Identity(4))
                    gpu.matrix.load_projection_matrix(pixelwise)
                    engine.view_draw(bpy.context, depsgraph)
                    read = gpu.state.active_framebuffer_get().read_color(0, 0, width, height, 4, 0, "FLOAT")
                pixels = np.array(read.to_list(), np.float32).reshape(height, width, 4)
                same = same + 1 if pixels.any() and np.array_equal(pixels, shown[0]) else 0
                shown[0] = pixels

    engine = next(one for one in bpy.types.HydraRenderEngine.__subclasses__() if getattr(one, "bl_idname", "") == "PATINA")
    kept = engine.update, engine.render
    engine.update, engine.render = lambda *_: None, draw
    bpy.ops.render.render()
    engine.update, engine.render = kept
    np.savez(os.path.join(folder, "viewport.npz"), pixels=shown[0], view=view.view_matrix, window=view.window_matrix)


def main(extension, folder, words):
    engines = [word for word in words if "=" not in word]
    settings = dict(word.split("=") for word in words if "=" in word)
    scene = make(folder)
    install(extension)  # now, for factory settings forget it
    bpy.ops.wm.usd_export(filepath=os.path.join(folder, "scene.usda"), export_materials=True, generate_preview_surface=False,
                          generate_materialx_network=True, export_textures_mode="KEEP", convert_world_material=True,
                          export_hair=True, export_volumes=True, export_animation=True)
    scene.frame_set(FRAME)
    scene.hydra.export_method = "USD"  # the quick one has other strengths of lights than the exporter
    for name, value in settings.items():
        setattr(scene.patina, name, type(getattr(scene.patina, name))(value))
    if "VIEWPORT" in engines:
        engines.remove("VIEWPORT")
        import gpu
        scene.render.engine = "PATINA"
        if hasattr(gpu, "init"):  # since Blender 5.3
            write_viewport(scene, folder)
    for engine in engines:
        scene.render.engine = engine
        if engine == "CYCLES":
            scene.cycles.samples, scene.cycles.use_denoising = 256, False
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        scene.render.filepath = os.path.join(folder, engine + ".exr")
        bpy.ops.render.render(write_still=True)
    if "PATINA" in engines:
        scene.render.engine = "PATINA"
        write_passes(scene, folder)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
