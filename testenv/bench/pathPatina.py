# SPDX-License-Identifier: Apache-2.0
"""The path tracing benchmark's scenes in Patina: a stage of UsdGeom, UsdLux and UsdShade, read as any other."""
import os
import sys
import time

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdShade, Vt

sys.path.append(os.path.dirname(os.path.abspath(__file__)))  # the launcher keeps folders of scripts out
import pathScenes  # noqa: E402
import pathWorker  # noqa: E402


def matrix(rows):
    return Gf.Matrix4d(*np.asarray(rows, float).ravel().tolist())


def material(stage, name, given):
    made = UsdShade.Material.Define(stage, f"/materials/{name}")
    kinds = Sdf.ValueTypeNames

    def shader(node, identity, **inputs):
        """:param inputs: type and value, or output and shader that is connected"""
        shaded = UsdShade.Shader.Define(stage, f"/materials/{name}/{node}")
        shaded.CreateIdAttr(identity)
        for key, (kind, value) in inputs.items():
            if isinstance(value, UsdShade.Shader):
                shaded.CreateInput(key, kinds.Token).ConnectToSource(value.ConnectableAPI(), kind)
            else:
                shaded.CreateInput(key, kind).Set(value)
        return shaded

    def mtlx(surface):
        made.CreateSurfaceOutput("mtlx").ConnectToSource(surface.ConnectableAPI(), "out")
        return made

    if "glass" in given:
        alpha = given["roughness"] ** 2
        lobe = shader("lobe", "ND_dielectric_bsdf", ior=(kinds.Float, given["glass"]), roughness=(kinds.Float2, (alpha, alpha)),
                      scatter_mode=(kinds.String, "RT"))
        return mtlx(shader("surface", "ND_surface", bsdf=("out", lobe)))
    if "diffuse" in given:
        lobe = shader("lobe", "ND_oren_nayar_diffuse_bsdf", color=(kinds.Color3f, tuple(given["diffuse"])))
        return mtlx(shader("surface", "ND_surface", bsdf=("out", lobe)))
    color, roughness, metallic = tuple(given["color"]), given["roughness"], given["metallic"]
    if given.get("standard"):
        return mtlx(shader("surface", "ND_standard_surface_surfaceshader", base=(kinds.Float, 1.0),
                           base_color=(kinds.Color3f, color), metalness=(kinds.Float, metallic),
                           specular_roughness=(kinds.Float, roughness)))
    surface = shader("surface", "UsdPreviewSurface", diffuseColor=(kinds.Color3f, color),
                     roughness=(kinds.Float, roughness), metallic=(kinds.Float, metallic))
    if given["image"]:
        place = shader("st", "UsdPrimvarReader_float2", varname=(kinds.String, "st"))
        image = shader("image", "UsdUVTexture", file=(kinds.Asset, given["image"]))
        image.CreateInput("st", kinds.Float2).ConnectToSource(place.ConnectableAPI(), "result")
        surface.GetInput("diffuseColor").ConnectToSource(image.ConnectableAPI(), "rgb")
    made.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
    return made


def mesh(stage, path, held, arrays, materials):
    made, i = UsdGeom.Mesh.Define(stage, path), held["number"]
    points, triangles = arrays[f"points{i}"], arrays[f"triangles{i}"]
    made.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    made.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(triangles), 3, np.int32)))
    made.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(triangles.ravel()))
    made.CreateSubdivisionSchemeAttr("none")
    if held["smooth"]:
        normals = np.zeros_like(points)
        corners = points[triangles]
        faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        for k in range(3):
            np.add.at(normals, triangles[:, k], faces)
        made.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True),
                                                                            1e-20)))
        made.SetNormalsInterpolation("vertex")
    if held["uv"]:
        UsdGeom.PrimvarsAPI(made).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "vertex").Set(
            Vt.Vec2fArray.FromNumpy(arrays[f"uv{i}"]))
    UsdShade.MaterialBindingAPI.Apply(made.GetPrim()).Bind(materials[held["material"]])


def write(folder):
    """:returns: the stage's file, and the scene's description"""
    scene, arrays = pathWorker.load(folder)
    path = os.path.join(folder, "stage.usdc")
    stage = Usd.Stage.CreateNew(path)
    UsdGeom.SetStageUpAxis(stage, "Y")
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    materials = {name: material(stage, name, given) for name, given in scene["materials"].items()}
    for name, held in scene["meshes"].items():
        transforms = f"instances{held['number']}"
        if transforms not in arrays:
            mesh(stage, f"/meshes/{name}", held, arrays, materials)
            continue
        instancer = UsdGeom.PointInstancer.Define(stage, f"/instances/{name}")
        mesh(stage, f"/instances/{name}/prototype", held, arrays, materials)
        instancer.CreatePrototypesRel().SetTargets([f"/instances/{name}/prototype"])
        places = arrays[transforms]
        turns = [matrix(m).ExtractRotationQuat() for m in places]
        instancer.CreateProtoIndicesAttr([0] * len(places))
        instancer.CreatePositionsAttr([Gf.Vec3f(*m[3, :3].tolist()) for m in places])
        instancer.CreateOrientationsAttr([Gf.Quath(q) for q in turns])
    for i, (place, width, height, radiance) in enumerate(scene["rects"]):
        light = UsdLux.RectLight.Define(stage, f"/lights/rect{i}")
        light.CreateWidthAttr(width)
        light.CreateHeightAttr(height)
        light.CreateIntensityAttr(radiance)
        light.AddTransformOp().Set(matrix(place))
    if scene["sky"]:
        UsdLux.DomeLight.Define(stage, "/lights/sky").CreateTextureFileAttr(scene["sky"])
    eye, target, view = scene["camera"]
    camera = UsdGeom.Camera.Define(stage, "/camera")
    camera.CreateHorizontalApertureAttr(36.0)
    camera.CreateVerticalApertureAttr(36.0 * scene["height"] / scene["width"])
    camera.CreateFocalLengthAttr(18.0 / np.tan(np.radians(view) / 2.0))
    camera.AddTransformOp().Set(matrix(pathScenes.facing(eye, target)))
    stage.GetRootLayer().Save()
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

    def draw(samples, seed, file, denoise):
        denoise = denoise and scene.get("denoise", False)
        experiment.draw(renderer, held, "/camera", {
            "width": scene["width"], "height": scene["height"], "samples": samples, "seed": seed, "threads": scene["threads"],
            "maxDepth": scene["depth"], "filterRadius": 0.5, "checkpointSeconds": 0.0,
            "aovs": list(denoiser.GUIDES) if denoise else [],
            "rouletteDepth": 1 if scene.get("roulette", True) else 4096,
            "methods": scene.get("methods", {})}, film)
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
