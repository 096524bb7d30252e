# SPDX-License-Identifier: Apache-2.0
"""The path tracing benchmark's scenes in Patina: a stage of UsdGeom, UsdLux and UsdShade, read as any other."""
import os
import sys
import time

import numpy as np
from pxr import Gf, Sdf

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [HERE, os.path.join(HERE, "..")]  # the launcher keeps folders of scripts out
import pathScenes  # noqa: E402
import pathWorker  # noqa: E402
import usda  # noqa: E402


def rows(matrix):
    """:returns: a matrix as tuples"""
    return tuple(map(tuple, np.asarray(matrix, float).tolist()))


def material(name, given):
    """:returns: its text"""
    if "glass" in given:
        return usda.lobe(name, "dielectric_bsdf", "/materials", ior=given["glass"], roughness=(given["roughness"] ** 2,) * 2,
                         scatter_mode="RT")
    if "diffuse" in given:
        return usda.lobe(name, "oren_nayar_diffuse_bsdf", "/materials", color=tuple(given["diffuse"]))
    color, roughness, metallic = tuple(given["color"]), given["roughness"], given["metallic"]
    if given.get("standard"):
        return usda.material(name, {"surface": ("ND_standard_surface_surfaceshader", {
            "base": 1.0, "base_color": color, "metalness": metallic, "specular_roughness": roughness})}, "/materials")
    if not given["image"]:
        return usda.preview(name, "/materials", diffuseColor=color, roughness=roughness, metallic=metallic)
    return usda.material(name, {
        "surface": ("UsdPreviewSurface", {"color3f diffuseColor": "<image>", "roughness": roughness, "metallic": metallic}),
        "image": ("UsdUVTexture", {"file": given["image"], "float2 st": "<st>"}),
        "st": ("UsdPrimvarReader_float2", {"varname": "st"})}, "/materials")


def mesh(name, held):
    """:returns: the text of a mesh without its points"""
    normals = ['normal3f[] normals = [] (interpolation = "vertex")'] if held["smooth"] else []
    return usda.prim("Mesh", name, *normals, st=[] if held["uv"] else None, bind=f"materials/{held['material']}",
                     subdivisionScheme="none")


def fill(layer, path, held, arrays):
    """Gives a mesh its points."""
    i = held["number"]
    points, triangles = arrays[f"points{i}"], arrays[f"triangles{i}"]
    usda.fill(layer, path, points=points, faceVertexCounts=np.full(len(triangles), 3), faceVertexIndices=triangles.ravel())
    if held["smooth"]:
        normals = np.zeros_like(points)
        corners = points[triangles]
        faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        for k in range(3):
            np.add.at(normals, triangles[:, k], faces)
        usda.fill(layer, path, normals=normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-20))
    if held["uv"]:
        usda.fill(layer, path, **{"primvars:st": arrays[f"uv{i}"]})


def write(folder):
    """:returns: the stage's file, and the scene's description"""
    scene, arrays = pathWorker.load(folder)
    places = {name: arrays.get(f"instances{held['number']}") for name, held in scene["meshes"].items()}
    lights = [usda.prim("RectLight", f"rect{i}", width=width, height=height, intensity=radiance, matrix=rows(place))
              for i, (place, width, height, radiance) in enumerate(scene["rects"])]
    if scene["sky"]:
        lights.append(usda.prim("DomeLight", "sky", f"asset inputs:texture:file = @{scene['sky']}@"))
    eye, target, view = scene["camera"]
    lens = (18.0 / np.tan(np.radians(view) / 2.0), 36.0, 36.0 * scene["height"] / scene["width"])
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(usda.stage(
        usda.prim("", "materials", *(material(name, given) for name, given in scene["materials"].items())),
        usda.prim("", "meshes", *(mesh(name, held) for name, held in scene["meshes"].items() if places[name] is None)),
        usda.prim("", "instances", *(usda.prim("PointInstancer", name, f"rel prototypes = </instances/{name}/prototype>",
                                               mesh("prototype", held), protoIndices=[0] * len(places[name]))
                                     for name, held in scene["meshes"].items() if places[name] is not None)),
        usda.prim("", "lights", *lights),
        usda.camera(lens=lens, matrix=rows(pathScenes.facing(eye, target))),
        metersPerUnit=1.0))
    for name, held in scene["meshes"].items():
        if places[name] is None:
            fill(layer, f"/meshes/{name}", held, arrays)
            continue
        fill(layer, f"/instances/{name}/prototype", held, arrays)
        usda.fill(layer, f"/instances/{name}", positions=places[name][:, 3, :3])
        turns = [Gf.Quath(Gf.Matrix4d(*m.ravel().tolist()).ExtractRotationQuat()) for m in places[name]]
        instancer = layer.GetPrimAtPath(f"/instances/{name}")
        Sdf.AttributeSpec(instancer, "orientations", Sdf.ValueTypeNames.QuathArray).default = turns
    path = os.path.join(folder, "stage.usdc")
    layer.Export(path)
    return path, scene


def prepare(folder):
    """:returns: a function that draws, as pathWorker.serve() takes it"""
    path, scene = write(folder)
    from patina import experiment
    from patina import stage as reader
    from patina.cli import compiled, denoiser

    module = compiled.load()
    if scene.get("denoise"):
        denoiser.prepare(module)
    held, film, renderer = module.Scene(), module.Film(), module.make_renderer("embree")
    with held.edit() as edit:
        reader.read_stage(reader.open_stage(path), edit, reader.StageOptions())

    def draw(samples, seed, file, plain):
        asked = {} if plain else scene
        denoise = asked.get("denoise", False)
        methods = {"pixelFilter": "sampled" if denoise else "splatted", **asked.get("methods", {})}
        experiment.draw(renderer, held, "/camera", {
            "width": scene["width"], "height": scene["height"], "samples": samples, "seed": seed, "threads": scene["threads"],
            "maxDepth": scene["depth"], "filterRadius": scene.get("filter", 0.5), "checkpointSeconds": 0.0,
            "aovs": list(denoiser.GUIDES) if denoise else [],
            "rouletteDepth": 1 if scene.get("roulette", True) else 4096,
            "methods": methods, "indirectRoughness": asked.get("blur", 0.0)}, film)
        if denoise:
            denoiser.run(module, film, scene["threads"])
        if file != os.devnull:
            np.save(file, np.asarray(film.resolve("color"))[..., :3])

    return draw


def main(folder):
    started = time.perf_counter()
    pathWorker.serve(prepare(folder), started)


if __name__ == "__main__":
    main(sys.argv[1])
