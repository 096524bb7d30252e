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
    surface = UsdShade.Shader.Define(stage, f"/materials/{name}/surface")
    if "glass" in given:
        alpha = given["roughness"] ** 2
        lobe = UsdShade.Shader.Define(stage, f"/materials/{name}/lobe")
        lobe.CreateIdAttr("ND_dielectric_bsdf")
        lobe.CreateInput("ior", Sdf.ValueTypeNames.Float).Set(given["glass"])
        lobe.CreateInput("roughness", Sdf.ValueTypeNames.Float2).Set((alpha, alpha))
        lobe.CreateInput("scatter_mode", Sdf.ValueTypeNames.String).Set("RT")
        surface.CreateIdAttr("ND_surface")
        surface.CreateInput("bsdf", Sdf.ValueTypeNames.Token).ConnectToSource(lobe.ConnectableAPI(), "out")
        made.CreateSurfaceOutput("mtlx").ConnectToSource(surface.ConnectableAPI(), "out")
        return made
    if "diffuse" in given:
        lobe = UsdShade.Shader.Define(stage, f"/materials/{name}/lobe")
        lobe.CreateIdAttr("ND_oren_nayar_diffuse_bsdf")
        lobe.CreateInput("color", Sdf.ValueTypeNames.Color3f).Set(tuple(given["diffuse"]))
        surface.CreateIdAttr("ND_surface")
        surface.CreateInput("bsdf", Sdf.ValueTypeNames.Token).ConnectToSource(lobe.ConnectableAPI(), "out")
        made.CreateSurfaceOutput("mtlx").ConnectToSource(surface.ConnectableAPI(), "out")
        return made
    if given.get("standard"):
        surface.CreateIdAttr("ND_standard_surface_surfaceshader")
        surface.CreateInput("base", Sdf.ValueTypeNames.Float).Set(1.0)
        surface.CreateInput("base_color", Sdf.ValueTypeNames.Color3f).Set(tuple(given["color"]))
        surface.CreateInput("metalness", Sdf.ValueTypeNames.Float).Set(given["metallic"])
        surface.CreateInput("specular_roughness", Sdf.ValueTypeNames.Float).Set(given["roughness"])
        made.CreateSurfaceOutput("mtlx").ConnectToSource(surface.ConnectableAPI(), "out")
        return made
    surface.CreateIdAttr("UsdPreviewSurface")
    color = surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    color.Set(tuple(given["color"]))
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(given["roughness"])
    surface.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(given["metallic"])
    if given["image"]:
        place = UsdShade.Shader.Define(stage, f"/materials/{name}/st")
        place.CreateIdAttr("UsdPrimvarReader_float2")
        place.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
        image = UsdShade.Shader.Define(stage, f"/materials/{name}/image")
        image.CreateIdAttr("UsdUVTexture")
        image.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(given["image"])
        image.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(place.ConnectableAPI(), "result")
        color.ConnectToSource(image.ConnectableAPI(), "rgb")
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
