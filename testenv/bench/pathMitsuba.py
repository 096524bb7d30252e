# SPDX-License-Identifier: Apache-2.0
"""The path tracing benchmark's scenes in Mitsuba 3 (PyPI: mitsuba). Arguments: the folder and a variant."""
import os
import sys
import time

import numpy as np

sys.path.append(os.path.dirname(os.path.abspath(__file__)))  # the launcher keeps folders of scripts out
import pathScenes  # noqa: E402
import pathWorker  # noqa: E402


def bsdf(given):
    if "glass" in given:
        return {"type": "roughdielectric", "distribution": "ggx", "alpha": given["roughness"] ** 2, "int_ior": given["glass"],
                "ext_ior": 1.0}
    if "diffuse" in given:
        return {"type": "diffuse", "reflectance": {"type": "rgb", "value": given["diffuse"]}}
    color = {"type": "bitmap", "filename": given["image"]} if given["image"] else {"type": "rgb", "value": given["color"]}
    return {"type": "twosided", "own": {"type": "principled", "base_color": color, "roughness": given["roughness"],
                                        "metallic": given["metallic"], "specular": 0.5}}


def shape(mi, folder, name, held, arrays):
    i = held["number"]
    points, triangles = arrays[f"points{i}"], arrays[f"triangles{i}"]
    made = mi.Mesh(name, len(points), len(triangles), has_vertex_normals=held["smooth"], has_vertex_texcoords=held["uv"])
    values = mi.traverse(made)
    values["vertex_positions"] = points.ravel()
    values["faces"] = triangles.astype(np.uint32).ravel()
    if held["uv"]:
        values["vertex_texcoords"] = (arrays[f"uv{i}"] * [1, -1] + [0, 1]).astype(np.float32).ravel()
    values.update()
    if held["smooth"]:
        made.recompute_vertex_normals()
    path = os.path.join(folder, name + ".ply")
    made.write_ply(path)
    return {"type": "ply", "filename": path, "face_normals": not held["smooth"],
            "bsdf": {"type": "ref", "id": held["material"]}}


def main(folder, variant):
    import drjit
    import mitsuba as mi

    started = time.perf_counter()
    mi.set_variant(variant)
    scene, arrays = pathWorker.load(folder)
    if scene["threads"]:
        drjit.set_thread_count(scene["threads"])

    def transform(rows):
        return mi.ScalarTransform4f(np.asarray(rows, float).T)

    eye, target, view = scene["camera"]
    filter_radius = scene.get("filter", 0.5)
    turned = transform(pathScenes.facing(eye, target)) @ mi.ScalarTransform4f().rotate([0, 1, 0], 180)
    made = {"type": "scene", "integrator": {"type": "path", "max_depth": scene["depth"] + 1,
                                               "rr_depth": 5 if scene.get("roulette", True) else 1 << 20},
            "sensor": {"type": "perspective", "fov": view, "to_world": turned,
                       "film": {"type": "hdrfilm", "width": scene["width"], "height": scene["height"],
                                "rfilter": {"type": "gaussian", "stddev": filter_radius / 2} if filter_radius > 0.5
                                else {"type": "box"}, "pixel_format": "rgb"},
                       "sampler": {"type": "multijitter" if variant.startswith("scalar") else "independent"}}}
    for name, given in scene["materials"].items():
        made[name] = {**bsdf(given), "id": name}
    for name, held in scene["meshes"].items():
        own, places = shape(mi, folder, name, held, arrays), f"instances{held['number']}"
        if places not in arrays:
            made["mesh_" + name] = own
            continue
        made["group_" + name] = {"type": "shapegroup", "own": own}
        for k, place in enumerate(arrays[places]):
            made[f"instance_{name}_{k}"] = {"type": "instance", "group": {"type": "ref", "id": "group_" + name},
                                            "to_world": transform(place)}
    for i, (place, width, height, radiance) in enumerate(scene["rects"]):
        scale = mi.ScalarTransform4f().rotate([0, 1, 0], 180) @ mi.ScalarTransform4f().scale([width / 2, height / 2, 1])
        made[f"rect{i}"] = {"type": "rectangle", "to_world": transform(place) @ scale,
                            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [radiance] * 3}}}
    if scene["sky"]:
        made["sky"] = {"type": "envmap", "filename": scene["sky"]}
    loaded = mi.load_dict(made)

    def draw(samples, seed, file, _):
        image = np.array(mi.render(loaded, spp=samples, seed=seed))
        if file != os.devnull:
            np.save(file, image[..., :3])

    pathWorker.serve(draw, started, mi.__version__)


if __name__ == "__main__":
    main(*sys.argv[1:3])
