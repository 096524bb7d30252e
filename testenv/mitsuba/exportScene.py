# SPDX-License-Identifier: Apache-2.0
"""Exports a test scene to Mitsuba 3, so that a renderer which nobody here wrote can check ours.

Only what the test scenes use is translated: meshes, spheres and cubes with constant materials made
of one diffuse, conductor, dielectric or subsurface node, homogeneous media inside closed objects,
instances, every light with a Mitsuba counterpart, and the camera. Anything else raises Unsupported, so a test can never compare
two different scenes.
"""
import math
import os

import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdShade


class Unsupported(Exception):
    """The scene holds something that has no translation here."""


def _transform(mi, matrix):
    return mi.ScalarTransform4f(np.array(matrix, dtype=np.float64).T)


def _value(shader, name, fallback):
    given = shader.GetInput(name)
    value = given.Get() if given else None
    return fallback if value is None else value


def _color(value):
    return {"type": "rgb", "value": [float(x) for x in value]}


def _source(shader, name):
    """The node connected to an input."""
    given = shader.GetInput(name)
    connected = given.GetConnectedSources()[0] if given else None
    return UsdShade.Shader(connected[0].source) if connected else None


def _medium(extinction, scattering, anisotropy):
    medium = {"type": "homogeneous", "albedo": _volume([s / e for s, e in zip(scattering, extinction)]),
              "sigma_t": _volume(extinction), "has_spectral_extinction": True}
    medium["phase"] = {"type": "hg", "g": anisotropy} if anisotropy else {"type": "isotropic"}
    return medium


def _volume(color):
    return {"type": "constvolume", "value": _color(color)}


def _anisotropic_vdf(vdf):
    if vdf.GetIdAttr().Get() != "ND_anisotropic_vdf":
        raise Unsupported(f"{vdf.GetPath()}: {vdf.GetIdAttr().Get()}")
    scattering = _value(vdf, "scattering", (0.0,) * 3)
    extinction = [a + s for a, s in zip(_value(vdf, "absorption", (0.0,) * 3), scattering)]
    return _medium(extinction, scattering, _value(vdf, "anisotropy", 0.0))


def _inverse_albedo(color):
    """1 - s^2 for the root s of (1 - s)(1 - 0.139 s) / (1 + 1.17 s) = color (van de Hulst), by halving."""
    low, high = 0.0, 1.0
    for _ in range(60):
        s = (low + high) / 2
        if (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s) > color:
            low = s
        else:
            high = s
    return low * low


def interior(material):
    """The Mitsuba medium inside objects of a bound material, or None."""
    volume = material.ComputeVolumeSource("mtlx")[0]
    if volume:
        return _anisotropic_vdf(_source(volume, "vdf"))
    surface = material.ComputeSurfaceSource("mtlx")[0]
    source = _source(surface, "bsdf") if surface else None
    if source and source.GetIdAttr().Get() == "ND_layer_vdf":
        return _anisotropic_vdf(_source(source, "base"))
    if source and source.GetIdAttr().Get() == "ND_subsurface_bsdf":
        g = _value(source, "anisotropy", 0.0)
        extinction = [1.0 / r for r in _value(source, "radius", (1.0,) * 3)]
        squares = [_inverse_albedo(c) for c in _value(source, "color", (0.18,) * 3)]
        return _medium(extinction, [e * (1 - q) / (1 - g * q) for e, q in zip(extinction, squares)], g)
    return None


def bsdf(mi, material):
    """The Mitsuba BSDF of a bound material."""
    surface = material.ComputeSurfaceSource("mtlx")[0] or material.ComputeSurfaceSource()[0]
    if not surface and material.ComputeVolumeSource("mtlx")[0]:
        return {"type": "null"}
    if surface.GetIdAttr().Get() == "UsdPreviewSurface":
        raise Unsupported(f"{surface.GetPath()}: UsdPreviewSurface")
    source = UsdShade.Shader(surface.GetInput("bsdf").GetConnectedSources()[0][0].source)
    kind = source.GetIdAttr().Get()
    if kind == "ND_layer_vdf":
        source = _source(source, "top")
        kind = source.GetIdAttr().Get()
    if kind == "ND_subsurface_bsdf":
        # The only lobe left is Lambert's, transmitted: light enters and leaves spread by the cosine.
        return {"type": "principledthin", "base_color": _color((1.0,) * 3), "diff_trans": 2.0, "spec_trans": 0.0}
    if kind == "ND_oren_nayar_diffuse_bsdf":
        if _value(source, "roughness", 0.0) != 0.0:
            raise Unsupported(f"{source.GetPath()}: roughness")
        connected = source.GetInput("color").GetConnectedSources()[0]
        if connected:
            return {"type": "twosided", "b": {"type": "diffuse", "reflectance": _image(mi, connected[0].source)}}
        return {"type": "twosided", "b": {"type": "diffuse", "reflectance": _color(_value(source, "color", (0.18,) * 3))}}
    alpha = _value(source, "roughness", Gf.Vec2f(0.05))
    if kind == "ND_conductor_bsdf":
        common = {
            "eta": _color(_value(source, "ior", (0.183, 0.421, 1.373))),
            "k": _color(_value(source, "extinction", (3.424, 2.346, 1.77))),
        }
        if max(alpha) == 0.0:
            return {"type": "twosided", "b": dict(type="conductor", **common)}
        rough = dict(type="roughconductor", distribution="ggx", alpha_u=alpha[0], alpha_v=alpha[1], **common)
        return {"type": "twosided", "b": rough}
    if kind == "ND_dielectric_bsdf" and _value(source, "scatter_mode", "R") == "RT":
        ior = float(_value(source, "ior", 1.5))
        if max(alpha) == 0.0:
            return {"type": "dielectric", "int_ior": ior, "ext_ior": 1.0}
        return {"type": "roughdielectric", "distribution": "ggx", "alpha": alpha[0], "int_ior": ior, "ext_ior": 1.0}
    raise Unsupported(f"{source.GetPath()}: {kind}")


def _image(mi, source):
    node = UsdShade.Shader(source.GetPrim())
    if node.GetIdAttr().Get() not in ("ND_image_color3", "UsdUVTexture"):
        raise Unsupported(node.GetPath())
    return {"type": "bitmap", "filename": node.GetInput("file").Get().resolvedPath,
            "filter_type": "nearest", "raw": True}  # without a colour space the numbers are meant


def _mesh(mi, name, points, counts, indices, uv=None):
    """A flat-shaded triangle mesh; polygons are convex and fanned out."""
    triangles, corners, start = [], [], 0
    for count in counts:
        for k in range(1, count - 1):
            corners.append((start, start + k, start + k + 1))
            triangles.append((indices[start], indices[start + k], indices[start + k + 1]))
        start += count
    triangles = np.array(triangles)
    if uv is not None:
        # Face-varying or not, every triangle gets vertices of its own.
        corner = np.array(corners).reshape(-1)
        flat = triangles.reshape(-1)
        uv = uv[flat] if len(uv) == len(points) else uv[corner]
        points = points[flat]
        triangles = np.arange(len(flat)).reshape(-1, 3)
    mesh = mi.Mesh(name, len(points), len(triangles), has_vertex_normals=False,
                   has_vertex_texcoords=uv is not None)
    params = mi.traverse(mesh)
    params["vertex_positions"] = np.ascontiguousarray(points, np.float32).ravel()
    params["faces"] = np.ascontiguousarray(triangles, np.uint32).ravel()
    if uv is not None:
        params["vertex_texcoords"] = np.ascontiguousarray(uv, np.float32).ravel()
    params.update()
    return mesh


def _write_mesh(mi, folder, name, *args):
    path = os.path.join(folder, name + ".ply")
    _mesh(mi, name, *args).write_ply(path)
    # USD counts v from the lower edge of an image, Mitsuba from the upper one.
    return {"type": "ply", "filename": path, "face_normals": True, "flip_tex_coords": True}


_CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
_CUBE_FACES = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]


def _points_to_world(points, matrix):
    m = np.array(matrix)
    return np.asarray(points, float) @ m[:3, :3] + m[3, :3]


def _radiance(light):
    lux = UsdLux.LightAPI(light)
    if lux.GetNormalizeAttr().Get() or lux.GetEnableColorTemperatureAttr().Get():
        raise Unsupported(f"{light.GetPath()}: normalize or colour temperature")
    scale = lux.GetIntensityAttr().Get() * 2.0 ** lux.GetExposureAttr().Get()
    return [scale * c for c in lux.GetColorAttr().Get()]


def _light(mi, prim, matrix):
    emitter = {"type": "area", "radiance": _color(_radiance(prim))}
    to_world = _transform(mi, matrix)
    t = mi.ScalarTransform4f
    kind = prim.GetTypeName()
    if kind == "RectLight":
        light = UsdLux.RectLight(prim)
        size = [light.GetWidthAttr().Get() / 2, light.GetHeightAttr().Get() / 2, 1]
        return {"type": "rectangle", "to_world": to_world @ t().rotate([0, 1, 0], 180) @ t().scale(size), "emitter": emitter}
    if kind == "DiskLight":
        radius = UsdLux.DiskLight(prim).GetRadiusAttr().Get()
        return {"type": "disk", "to_world": to_world @ t().rotate([0, 1, 0], 180) @ t().scale(radius), "emitter": emitter}
    if kind == "SphereLight":
        radius = UsdLux.SphereLight(prim).GetRadiusAttr().Get()
        return {"type": "sphere", "to_world": to_world @ t().scale(radius), "emitter": emitter}
    if kind == "CylinderLight":
        light = UsdLux.CylinderLight(prim)
        half = light.GetLengthAttr().Get() / 2
        return {"type": "cylinder", "p0": [-half, 0, 0], "p1": [half, 0, 0], "radius": light.GetRadiusAttr().Get(),
                "to_world": to_world, "emitter": emitter}
    if kind == "DistantLight":
        if UsdLux.DistantLight(prim).GetAngleAttr().Get() != 0.0:
            raise Unsupported(f"{prim.GetPath()}: angle")
        direction = matrix.TransformDir(Gf.Vec3d(0, 0, -1)).GetNormalized()
        return {"type": "directional", "direction": list(direction), "irradiance": _color(_radiance(prim))}
    if kind == "DomeLight":
        if UsdLux.DomeLight(prim).GetTextureFileAttr().Get():
            # Its rows of texels lie on the poles, ours half a texel away: two different domes.
            raise Unsupported(f"{prim.GetPath()}: dome texture")
        return {"type": "constant", "radiance": _color(_radiance(prim))}
    raise Unsupported(f"{prim.GetPath()}: {kind}")


def _camera(mi, prim, width, height, spp):
    camera = UsdGeom.Camera(prim)
    matrix = camera.ComputeLocalToWorldTransform(Usd.TimeCode.Default())
    focal, aperture = camera.GetFocalLengthAttr().Get(), camera.GetHorizontalApertureAttr().Get()
    sensor = {
        "type": "perspective",
        "fov": math.degrees(2 * math.atan(aperture / 2 / focal)),
        "fov_axis": "x",
        "to_world": _transform(mi, matrix) @ mi.ScalarTransform4f().rotate([0, 1, 0], 180),
        "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
                 "pixel_format": "rgb", "component_format": "float32"},
        "sampler": {"type": "independent", "sample_count": spp},
    }
    if camera.GetFStopAttr().Get():
        sensor["type"] = "thinlens"
        sensor["aperture_radius"] = focal * 0.1 / camera.GetFStopAttr().Get() / 2
        sensor["focus_distance"] = camera.GetFocusDistanceAttr().Get()
    return sensor


def export(mi, stage, folder, width, height, spp, max_depth=17):
    """A dictionary for mi.load_dict().

    :param mi: the mitsuba module, with a variant set
    :param folder: where meshes are written
    :raises Unsupported: when a prim has no translation
    """
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": max_depth, "rr_depth": 100}}
    cache = UsdGeom.XformCache()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not prim.IsActive() or not prim.IsA(UsdGeom.Imageable):
            continue
        if UsdGeom.Imageable(prim).ComputeVisibility() == UsdGeom.Tokens.invisible:
            continue
        matrix = cache.GetLocalToWorldTransform(prim)
        name = prim.GetPath().pathString[1:].replace("/", "_")
        if prim.IsA(UsdGeom.Camera):
            scene["sensor"] = _camera(mi, prim, width, height, spp)
        elif prim.HasAPI(UsdLux.LightAPI) and not prim.IsA(UsdGeom.Gprim):
            scene[name] = _light(mi, prim, matrix)
        elif prim.IsA(UsdGeom.Gprim):
            if prim.HasAPI(UsdLux.LightAPI):
                raise Unsupported(f"{prim.GetPath()}: mesh light")
            material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
            shape = _gprim(mi, prim, matrix, folder, name)
            shape["bsdf"] = bsdf(mi, material)
            inside = interior(material)
            if inside:
                shape["interior"] = inside
                scene["integrator"] = {"type": "volpathmis", "max_depth": -1, "rr_depth": 30}
            scene[name] = shape
        elif prim.IsA(UsdGeom.PointInstancer):
            raise Unsupported(f"{prim.GetPath()}: point instancer")
    return scene


def _gprim(mi, prim, matrix, folder, name):
    if prim.IsA(UsdGeom.Sphere):
        radius = UsdGeom.Sphere(prim).GetRadiusAttr().Get()
        return {"type": "sphere", "to_world": _transform(mi, matrix) @ mi.ScalarTransform4f().scale(radius)}
    if prim.IsA(UsdGeom.Cube):
        half = UsdGeom.Cube(prim).GetSizeAttr().Get() / 2
        return _write_mesh(mi, folder, name, _points_to_world(_CUBE * half, matrix), [4] * 6, _CUBE_FACES)
    if prim.IsA(UsdGeom.Mesh):
        mesh = UsdGeom.Mesh(prim)
        if mesh.GetSubdivisionSchemeAttr().Get() != UsdGeom.Tokens.none:
            raise Unsupported(f"{prim.GetPath()}: subdivision")
        st = UsdGeom.PrimvarsAPI(prim).GetPrimvar("st")
        uv = np.array(st.ComputeFlattened()) if st and st.HasValue() else None
        return _write_mesh(mi, folder, name, _points_to_world(mesh.GetPointsAttr().Get(), matrix),
                           mesh.GetFaceVertexCountsAttr().Get(), mesh.GetFaceVertexIndicesAttr().Get(), uv)
    raise Unsupported(f"{prim.GetPath()}: {prim.GetTypeName()}")


def replace_by_meshes(stage):
    """Replaces spheres, cones and cylinders by meshes and point instancers by copies, so that both
    renderers are given the same shapes."""
    for prim in list(Usd.PrimRange(stage.GetPseudoRoot())):
        if prim.IsValid() and prim.IsA(UsdGeom.PointInstancer) and not prim.GetParent().IsA(UsdGeom.PointInstancer):
            _unroll(stage, UsdGeom.PointInstancer(prim))
    for prim in list(Usd.PrimRange(stage.GetPseudoRoot())):
        kind = prim.GetTypeName()
        if kind not in ("Sphere", "Cone", "Cylinder"):
            continue
        points, counts, indices = _shape(prim, kind)
        for name in ("radius", "height", "axis", "extent"):
            prim.RemoveProperty(name)
        prim.SetTypeName("Mesh")
        mesh = UsdGeom.Mesh(prim)
        mesh.CreatePointsAttr(points)
        mesh.CreateFaceVertexCountsAttr(counts)
        mesh.CreateFaceVertexIndicesAttr(indices)
        mesh.CreateSubdivisionSchemeAttr("none")


def _shape(prim, kind):
    """A coarse polygon mesh in place of a round shape; the profile runs from bottom to top."""
    segments, rings = 24, 12
    if kind == "Sphere":
        r = UsdGeom.Sphere(prim).GetRadiusAttr().Get()
        profile = [(r * math.sin(math.pi * k / rings), -r * math.cos(math.pi * k / rings)) for k in range(1, rings)]
        profile = [(0, -r)] + profile + [(0, r)]
        axis = "Z"
    else:
        shape = UsdGeom.Cone(prim) if kind == "Cone" else UsdGeom.Cylinder(prim)
        r, h, axis = shape.GetRadiusAttr().Get(), shape.GetHeightAttr().Get(), shape.GetAxisAttr().Get()
        profile = [(0, -h / 2), (r, -h / 2)] + ([(r, h / 2)] if kind == "Cylinder" else []) + [(0, h / 2)]
    turn = {"X": lambda a, b, c: (c, a, b), "Y": lambda a, b, c: (b, c, a), "Z": lambda a, b, c: (a, b, c)}[axis]
    points, counts, indices = [], [], []
    for radius, z in profile:
        for s in range(segments):
            angle = 2 * math.pi * s / segments
            points.append(turn(radius * math.cos(angle), radius * math.sin(angle), z))
    for k in range(len(profile) - 1):
        for s in range(segments):
            n = (s + 1) % segments
            quad = [k * segments + s, k * segments + n, (k + 1) * segments + n, (k + 1) * segments + s]
            if profile[k][0] == 0:
                quad = [quad[0], quad[2], quad[3]]
            elif profile[k + 1][0] == 0:
                quad = quad[:3]
            counts.append(len(quad))
            indices.extend(quad)
    return points, counts, indices


def _unroll(stage, instancer, depth=0):
    """Copies the prototypes of an instancer to every instance, under transforms of their own."""
    prim = instancer.GetPrim()
    transforms = instancer.ComputeInstanceTransformsAtTime(Usd.TimeCode.Default(), Usd.TimeCode.Default(),
                                                           UsdGeom.PointInstancer.IncludeProtoXform)
    targets = instancer.GetPrototypesRel().GetTargets()
    parent = prim.GetPath().GetParentPath()
    layer = stage.GetRootLayer()
    from pxr import Sdf

    for i, index in enumerate(instancer.GetProtoIndicesAttr().Get()):
        path = parent.AppendChild(f"{prim.GetName()}_{depth}_{i}")
        Sdf.CopySpec(layer, targets[index], layer, path)
        copy = stage.GetPrimAtPath(path)
        if copy.IsA(UsdGeom.PointInstancer):
            holder = parent.AppendChild(f"{prim.GetName()}_{depth}_{i}_holder")
            xform = UsdGeom.Xform.Define(stage, holder)
            xform.AddTransformOp().Set(transforms[i])
            inner = holder.AppendChild("inner")
            Sdf.CopySpec(layer, path, layer, inner)
            stage.RemovePrim(path)
            _unroll(stage, UsdGeom.PointInstancer(stage.GetPrimAtPath(inner)), depth + 1)
            continue
        xformable = UsdGeom.Xformable(copy)
        xformable.ClearXformOpOrder()
        xformable.AddTransformOp(opSuffix="instance").Set(transforms[i])
    stage.RemovePrim(prim.GetPath())
