# SPDX-License-Identifier: Apache-2.0
# Made by `./patina python testenv/generateStubs.py`; edits are lost.
"""The compiled part of Patina; docs/api/module.md says what values look like."""
from __future__ import annotations
import numpy
import numpy.typing
import typing
class TemporaryFailure(RuntimeError):
    pass
class Network:
    """
    A material as authored.
    """
    def __init__(self, path: str) -> None:
        ...
    def add_node(self, path: str, id: str) -> None:
        """
        A node by its definition's name, such as ND_conductor_bsdf. ValueError where the path is taken; a definition that is not known is warned of when the material is compiled.
        """
    def connect(self, node: str, input: str, source: str, output: str = '') -> None:
        """
        Connects a node's input to an output of another node; empty: its only one. KeyError where the node was not added.
        """
    def nodes(self) -> list[typing.Any]:
        """
        Dicts of path, id, inputs and connections.
        """
    def set_input(self, node: str, input: str, type: str, value: typing.Any, color_space: str = '') -> None:
        """
        ValueError when the value does not fit the type. Types are MaterialX's or Sdf's.
        """
    def set_terminal(self, name: str, node: str, output: str = '') -> None:
        """
        Names the node that is the material's surface, displacement or volume.
        """
    def terminals(self) -> dict[str, typing.Any]:
        """
        Name -> (node, output).
        """
    def upgrade(self) -> list[typing.Any]:
        """
        Makes a network of MaterialX 1.38 one of 1.39, whose nodes differ. Returns warnings, dicts as Scene.warnings() gives them.
        """
    @property
    def empty(self) -> bool:
        """
        Whether it has no node.
        """
    @property
    def path(self) -> str:
        """
        The material's own path.
        """
class SceneEdit:
    """
    A batch of changes to a scene.
    """
    def __enter__(self) -> SceneEdit:
        ...
    def __exit__(self, *args: typing.Any) -> None:
        ...
    def clear(self) -> None:
        """
        Removes everything that was there before.
        """
    def commit(self) -> None:
        """
        Makes the changes the scene's newest state, all at once; a `with` block does so.
        """
    def remove(self, path: str) -> None:
        """
        Removes the prim with that path, of whatever kind, if there is one.
        """
    def set_camera(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomCamera; keywords are the fields of Camera. inputs: a dictionary of values by camera_input_names().
        Keywords: transform, orthographic, clip_near, clip_far, clipping_planes, shutter_open, shutter_close, exposure_scale, inputs, horizontal_aperture, vertical_aperture, horizontal_aperture_offset, vertical_aperture_offset, focal_length, f_stop, focus_distance.
        """
    def set_curves(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomBasisCurves; keywords are the fields of Curves.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points, curve_vertex_counts, basis, wrap.
        """
    def set_hermite_curves(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomHermiteCurves, as Bezier curves.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points, tangents, curve_vertex_counts.
        """
    def set_implicit(self, path: str, **kwargs: typing.Any) -> None:
        """
        Sphere, cube, cone, cylinder, capsule or plane.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, shape, axis, radius, radius_top, height, size, width, length.
        """
    def set_instancer(self, path: str, **kwargs: typing.Any) -> None:
        """
        Copies of groups; keywords are Instancer's fields.
        Keywords: group, prototypes, prototype_indices, transforms, ids, categories, primvars, visibility, names, assets, asset_name.
        """
    def set_light(self, path: str, **kwargs) -> None:
        """
        A UsdLux light; keywords are the fields of Light. filters: a list of dicts of path, type, transform and light_filter_inputs(). portals: of path, transform, width and height. network: of what inputs are connected to, a terminal by each input's name.
        """
    def set_material(self, path: str, network: Network) -> None:
        """
        A material; prims name it by its path.
        """
    def set_mesh(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomMesh; keywords are the fields of Mesh.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points, face_vertex_counts, face_vertex_indices, hole_indices, scheme, interpolate_boundary, face_varying_linear_interpolation, triangle_subdivision_rule, crease_indices, crease_lengths, crease_sharpnesses, corner_indices, corner_sharpnesses, refine_level.
        """
    def set_meters_per_unit(self, meters_per_unit: float) -> None:
        """
        Length of a scene unit in metres, above 0.
        """
    def set_nurbs_curves(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomNurbsCurves, as Bezier curves; ranges are two numbers per curve.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points, curve_vertex_counts, orders, knots, ranges, weights.
        """
    def set_nurbs_patch(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomNurbsPatch; weights are one per point, ranges two numbers; trim points three each: u and v, multiplied by w, and w.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points, u_vertex_count, v_vertex_count, u_order, v_order, u_knots, v_knots, u_range, v_range, weights, trim_counts, trim_orders, trim_vertex_counts, trim_knots, trim_ranges, trim_points, trim_keep_inside, refine_level.
        """
    def set_points(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomPoints; keywords are the fields of Points.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points.
        """
    def set_rendering_color_space(self, name: str) -> None:
        """
        The linear space in which colours of lights and primvars are given, '' for Rec.709. Give them anew after it has changed.
        """
    def set_splats(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdVolParticleField; shape is that of its kernels, orientations are quaternions, the real part first.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, shape, positions, orientations, scales, opacities, degree, harmonics, color_space.
        """
    def set_tet_mesh(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdGeomTetMesh; tets are four indices of points each, surface three or nothing.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, points, tets, surface.
        """
    def set_volume(self, path: str, **kwargs: typing.Any) -> None:
        """
        A UsdVolVolume; fields are given by their names, files and the grids in the files. light: what its glow gives to others, over what is seen of it, 1 by default.
        Keywords: group, transform, visibility, catching, matte_name, asset_name, material, subsets, primvars, categories, double_sided, left_handed, light_group, marks, field_names, field_files, field_grids, light.
        """
    def warn(self, prim: str, input: str, id: str, *args) -> None:
        """
        Adds a warning to the scene's: a message of base/messages.def with its fields, in the order of its row.
        """
class Scene:
    """
    The renderer's own scene.
    """
    def __init__(self) -> None:
        ...
    def camera(self, path: str) -> dict[str, typing.Any]:
        """
        A camera's values by set_camera()'s keywords, has_overscan, and image_aspect, the width over the height that its image has of itself; KeyError where there is none.
        """
    def clear_warnings(self) -> None:
        """
        Forgets all warnings.
        """
    def dump(self, values: int = 16) -> str:
        """
        The scene as text; arrays are cut after so many values.
        """
    def edit(self) -> SceneEdit:
        """
        A new batch of changes, which commits at the end of a `with` block.
        """
    def material(self, path: str) -> Network:
        """
        A material as it was set; KeyError where there is none.
        """
    def paths(self, kind: str) -> list[str]:
        """
        Paths of all geometry, instancers, lights, cameras or materials; ValueError for another kind.
        """
    def warn(self, prim: str, input: str, id: str, *args) -> None:
        """
        Adds a warning, as SceneEdit.warn(); one that is there already is counted.
        """
    def warnings(self) -> list[typing.Any]:
        """
        Problems of the scene: dicts of prim, input, id, message, fields of the message by name, and count, how often it was met.
        """
    @property
    def meters_per_unit(self) -> float:
        """
        Length of a scene unit in metres.
        """
    @property
    def version(self) -> int:
        """
        Grows by one with every commit.
        """
class Film:
    """
    Accumulates the samples of an image.
    """
    def __init__(self) -> None:
        ...
    def add_color(self, x: int, y: int, radiance: typing.Sequence[float], alpha: float = 1.0) -> bool:
        """
        Adds a sample of linear colour; False, and black, where it is not finite.
        """
    def copy(self) -> Film:
        """
        An equal film of its own.
        """
    def load_checkpoint(self, file: str) -> None:
        """
        Reads what save_checkpoint() wrote; RuntimeError where it is something else.
        """
    def relative_error(self, shared: bool = False) -> float:
        """
        Expected mean of |luminance - its limit| / (limit + 0.01) over the pixels, by their samples; shared: all pixels have the same random numbers (rasterizer).
        """
    def reset(self, width: int, height: int, aovs: list[str] = [], keep: bool = False) -> None:
        """
        Clears the film; ValueError names an unknown AOV.
        """
    def resolve(self, name: str) -> numpy.typing.NDArray[typing.Any]:
        """
        Array of height x width (x components), top row first; int32 for ids.
        """
    def save_checkpoint(self, file: str) -> None:
        """
        Writes the samples to a file; RuntimeError says in one line why not.
        """
    @property
    def aovs(self) -> list[str]:
        """
        Names besides color and alpha.
        """
    @property
    def dropped_samples(self) -> int:
        """
        Samples that were not finite; they count as black.
        """
    @property
    def has_deep(self) -> bool:
        """
        Whether samples were kept by their depths, for deep images.
        """
    @property
    def height(self) -> int:
        """
        Pixels.
        """
    @property
    def resume_token(self) -> str:
        """
        The origin of the film, in words; a checkpoint of another is refused.
        """
    @resume_token.setter
    def resume_token(self, arg0: str) -> None:
        ...
    @property
    def width(self) -> int:
        """
        Pixels.
        """
class ImageData:
    """
    An image as it is in its file.
    """
    @property
    def channels(self) -> list[str]:
        ...
    @property
    def display_height(self) -> int:
        ...
    @property
    def display_width(self) -> int:
        ...
    @property
    def height(self) -> int:
        ...
    @property
    def metadata(self) -> dict[str, typing.Any]:
        """
        The file's own metadata, by name.
        """
    @property
    def pixel_aspect_ratio(self) -> float:
        ...
    @property
    def pixels(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        Float array of height x width x channels, top row first, without a copy.
        """
    @property
    def width(self) -> int:
        ...
    @property
    def x(self) -> int:
        ...
    @property
    def y(self) -> int:
        ...
class AtomicFile:
    """
    A file that appears all at once: written to temporary_path, and renamed by commit(). RuntimeError where the path is no regular file.
    """
    def __init__(self, path: str) -> None:
        ...
    def commit(self) -> None:
        """
        Renames what was written to its place; RuntimeError where that fails.
        """
    def discard(self) -> None:
        """
        Ends without the file, unless it was committed.
        """
    @property
    def temporary_path(self) -> str:
        """
        Where to write; it has the file's own ending.
        """
class Tile:
    """
    A rectangle of pixels, ends excluded.
    """
    @property
    def x0(self) -> int:
        ...
    @property
    def x1(self) -> int:
        ...
    @property
    def y0(self) -> int:
        ...
    @property
    def y1(self) -> int:
        ...
class PartialWriter:
    """
    Writes the file of a part; RuntimeError says in one line why not.
    """
    def __init__(self, file: str, description: str, tiles: list[Tile]) -> None:
        ...
    def add(self, film: Film) -> None:
        """
        A film with the samples of one span, or of all spans from the first.
        """
    def commit(self, report: str) -> None:
        ...
class PartialErrors:
    """
    What the tiles of parts told of their error while they were merged.
    """
    def __init__(self) -> None:
        ...
    def samples_of_whole(self, tolerance: float, min_samples: int) -> int:
        """
        The count at which the image rendered at once was done; 0: no tile went on after it.
        """
    def steps_of_whole(self, min_samples: int) -> list[int]:
        """
        Counts before the last one at which that image had its denoised error looked at.
        """
class Renderer:
    """
    Renders a scene into a film, in the background.
    """
    def pause(self) -> None:
        """
        Holds the render; the film keeps its samples.
        """
    def progress(self) -> dict[str, typing.Any]:
        """
        A dict[str, typing.Any] with the fields of RenderProgress.
        """
    def resume(self) -> None:
        """
        Goes on after pause().
        """
    def start(self, scene: Scene, camera: str, settings: dict[str, typing.Any], film: Film) -> None:
        """
        Starts rendering the scene's newest state; ValueError names an unknown setting.
        """
    def stop(self) -> None:
        """
        Returns when no thread works on the film any more.
        """
    def wait(self, timeout: float = -1.0) -> bool:
        """
        Waits for the end, or for so many seconds. Returns whether the render has ended.
        """
    @property
    def is_running(self) -> bool:
        """
        Whether it renders, or is paused.
        """
class MaterialProbe:
    """
    A compiled material at one shading point: its lobes, and light that passes straight on.
    """
    def __init__(self, network: Network, methods: dict[str, str] = {}, tolerance: float = -1.0) -> None:
        ...
    def albedo(self, wo: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float32]:
        """
        Directional albedo: what is reflected, transmitted and passes straight on.
        """
    def emission(self, wo: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float32]:
        ...
    def emission_at(self, uv: numpy.typing.ArrayLike, footprint: float = 0.0) -> numpy.typing.NDArray[numpy.float32]:
        """
        Emission of the unit square of the xy plane at its points (u, v), seen from above.
        """
    def eval(self, wo: numpy.typing.ArrayLike, wi: numpy.typing.ArrayLike) -> tuple[typing.Any, ...]:
        """
        f without the cosine, and the density of sample(); delta lobes and light that passes straight on have no part in it.
        """
    def move_to(self, u: float, v: float) -> None:
        """
        Chooses the point (u, v) of the unit square in the xy plane for all that follows.
        """
    def opacity(self, wo: typing.Sequence[float] = [0.0, 0.0, 1.0]) -> float:
        """
        Presence: the chance that light meets the surface rather than pass straight on.
        """
    def sample(self, wo: numpy.typing.ArrayLike, u: numpy.typing.ArrayLike) -> dict[str, typing.Any]:
        """
        wi, weight (f cos / pdf), pdf and event (0: no sample) for rows of four random numbers.
        """
    @property
    def constant(self) -> bool:
        ...
    @property
    def stochastic(self) -> bool:
        """
        Whether a lobe has no formula: eval() and albedo() are then means over random walks (256 and 2048 of them), and densities estimates.
        """
    @property
    def uses_uv(self) -> bool:
        ...
    @property
    def warnings(self) -> list[typing.Any]:
        ...
class RasterProbe:
    """
    A material at one shading point, computed by the rasterizer's driver from its GLSL. RuntimeError where there is no OpenGL. It uses the shader of one of `like` where only numbers differ.
    """
    def __init__(self, network: Network, methods: dict[str, str] = {}, like: list[RasterProbe] = []) -> None:
        ...
    def albedo(self, wo: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float32]:
        ...
    def emission(self, wo: numpy.typing.ArrayLike) -> numpy.typing.NDArray[numpy.float32]:
        ...
    def eval(self, wo: numpy.typing.ArrayLike, wi: numpy.typing.ArrayLike) -> tuple[typing.Any, ...]:
        ...
    def move_to(self, u: float, v: float) -> None:
        ...
    def opacity(self, wo: typing.Sequence[float] = [0.0, 0.0, 1.0]) -> float:
        ...
    def sample(self, wo: numpy.typing.ArrayLike, u: numpy.typing.ArrayLike) -> dict[str, typing.Any]:
        ...
    @property
    def shares_shader(self) -> bool:
        ...
    @property
    def warnings(self) -> list[typing.Any]:
        ...
def accumulate(frames: list[dict[str, numpy.typing.ArrayLike]], current: int, threads: int = 0) -> tuple[typing.Any, ...]:
    """
    The colour of a frame, averaged with that of the frames around it where they see the same surface in the same light, and of how many frames each pixel is the mean. A frame is a dict[str, typing.Any] of arrays: color, alpha, denoisingAlbedo, denoisingNormal, depth, motionForward, motionBackward and, where they differ, sampleCount; frames are one time code apart.
    """
def albedo_table() -> numpy.typing.NDArray[numpy.float32]:
    """
    The baked directional albedos, in the layout of shaders/lib/albedoTable.glsl.
    """
def camera_input_names() -> list[str]:
    """
    Attributes of cameras beyond UsdGeomCamera's own; each may stand after 'primvars:' too.
    """
def camera_inputs() -> list[typing.Any]:
    """
    Numbers of UsdGeomCamera: (attribute, keyword of set_camera(), fallback).
    """
def channels_of_aov(aov: str) -> str:
    """
    The prefix of an AOV's channels in files; ValueError says why there is no such AOV.
    """
def check_image_path(path: str, aovs: list[str] = []) -> None:
    """
    RuntimeError says early why an image could not be written.
    """
def check_methods(methods: dict[str, str]) -> str:
    """
    Empty, or a sentence that names the choice point or method that does not exist.
    """
def check_output(path: str) -> None:
    """
    RuntimeError says early why a file could not be written; its folder is not touched.
    """
def choice_points() -> list[typing.Any]:
    """
    List of (choice point, list of (method, description)); the first is the default.
    """
def color_spaces() -> list[str]:
    """
    Names of colour spaces that colours and textures may have.
    """
def color_to_rendering(numbers: list[float], color_space: str, rendering: str = '') -> typing.Any:
    """
    A colour value in the rendering space (linear Rec.709): three numbers are converted, what follows them stays. None for an unknown space.
    """
def colors_to_rendering(colors: numpy.typing.ArrayLike, color_space: str, rendering: str = '') -> typing.Any:
    """
    The same for an array of colours, one a row of three or more numbers.
    """
def default_render_settings() -> dict[str, typing.Any]:
    """
    Every setting with its default.
    """
def denoise(film: Film, threads: int = 0, aovs: bool = False) -> None:
    """
    Replaces the film's colour by what Open Image Denoise makes of it, led by the AOVs denoisingAlbedo and denoisingNormal where both are there; the noisy one is color.noisy then. With `aovs` likewise those of light. RuntimeError says in one line why not.
    """
def denoise_pixels(color: numpy.typing.ArrayLike, albedo: numpy.typing.ArrayLike, normal: numpy.typing.ArrayLike, samples: float, threads: int = 0) -> numpy.typing.NDArray[numpy.float32]:
    """
    What Open Image Denoise makes of an image of height x width x 3, led by albedo and normals; samples of a pixel say how noisy these are. RuntimeError says in one line why not.
    """
def denoised_error(film: Film, threads: int = 0) -> float:
    """
    Film.relative_error() of the colour that denoise() leaves, at most: from halves of the samples (AOVs denoisingHalfColor, denoisingHalfAlbedo, denoisingHalfNormal), each of which tells how far the other is off when denoised. Below 0 without them. RuntimeError says in one line why not.
    """
def denoiser_missing() -> str:
    """
    Why images cannot be denoised here, in one line; empty where they can.
    """
def display_color_network() -> Network:
    """
    The material of prims without one.
    """
def displays() -> list[str]:
    """
    Displays of the OCIO configuration, in its order.
    """
def end_at_second_signal(numbers: list[int], seconds: float) -> None:
    """
    Of these signals, by number, the first goes to Python's handler, and the next of any does what it does by default, even where Python hears none. The first number counts once within so many seconds. To be called again after signal.signal(), which takes the signal back and begins to count anew. Signals that are ignored, or have no handler, stay so.
    """
def expand_material(network: Network) -> tuple[typing.Any, ...]:
    """
    The simplified graph of a material as a network of primitive nodes, and the list of warnings.
    """
def explain_material(network: Network, warnings: typing.Any = None, methods: dict[str, str] = {}) -> str:
    """
    The model of a material, as text. Warnings are appended to the list.
    """
def ignored_light_filter_inputs() -> dict[str, typing.Any]:
    """
    Inputs of light filters that are not evaluated -> the values, separated by blanks, at which they do nothing.
    """
def instruction_set() -> str:
    """
    The arithmetic of this build, in words: renders of two machines have equal bits where build and instruction set are equal.
    """
def keep_noisy(film: Film) -> None:
    """
    In place of denoise(): colour and color.noisy are both the means.
    """
def light_filter_inputs() -> list[typing.Any]:
    """
    Inputs of light filters: (names in schemas, separated by blanks, key of a filter of set_light(), type).
    """
def light_filter_types() -> dict[str, typing.Any]:
    """
    Types of light filters, separated by blanks where several are read alike -> word.
    """
def light_inputs() -> list[typing.Any]:
    """
    Inputs of lights: (Light, Shape, Shaping, Shadow or Image, name in the schema, keyword of set_light(), float, bool, vec3 or std::string).
    """
def light_path_accepts(expression: str, paths: list[list[tuple[str, str, str]]]) -> list[bool]:
    """
    Which paths fit a light path expression. A path is a list of events (type, scattering, label), such as [('C', 'x', ''), ('R', 'D', ''), ('L', 'x', 'key')]. ValueError says what is wrong with the expression, and where.
    """
def light_path_states(expression: str) -> int:
    """
    States of the smallest automaton of a light path expression.
    """
def light_radiance(**kwargs) -> typing.Sequence[float]:
    """
    intensity 2^exposure color of a light, by the keywords of set_light().
    """
def light_types() -> dict[str, typing.Any]:
    """
    UsdLux types, separated by blanks where several are read alike -> word for set_light().
    """
def limits() -> dict[str, int]:
    """
    The limits that hold in this process, by name.
    """
def machine() -> dict[str, typing.Any]:
    """
    A dict[str, typing.Any]: compiler, openglRenderer, openglVersion, and openglError, why there is no OpenGL.
    """
def make_renderer(backend: str = 'embree') -> Renderer:
    """
    A renderer of the back end embree, raster, interactive or auto; ValueError for another name. Where raster cannot run, the path tracer renders instead, with a warning.
    """
def mark_names() -> list[str]:
    """
    Primvars, without 'primvars:', that say which rays see a prim and what mattes make of it.
    """
def measure_methods(point: str = '', timed: bool = True) -> list[typing.Any]:
    """
    Measures the methods of a choice point, or of all, here and now, on one thread.
    """
def merge_partial(film: Film, file: str, tolerance: float = 0.0, min_samples: int = 0, samples: int = 0, errors: PartialErrors | None = None) -> str:
    """
    Adds a part behind the samples that a film has, and returns its report. Of the same tiles the parts come in the order of their samples.
    """
def method_figures(point: str, method: str) -> typing.Any:
    """
    dict[str, typing.Any] of errorOf, cost (over the default method), mean and largest error over all subjects; None where nothing is measured.
    """
def method_table() -> list[typing.Any]:
    """
    The measured methods as the program was built with them: list of dicts (point, method, subject, errorOf, ns, cost, mean, largest, rms, and errors over cells with kind, reflectance, axis, axisEnd and truths as in materialNetwork/plan/methodTable.h).
    """
def model_warnings() -> list[typing.Any]:
    """
    Errors in the models of the library, those of PATINA_MODEL_PATH among them.
    """
def mtlx_files(path: str) -> list[bytes]:
    """
    The files that read_mtlx looks at, as bytes: a document and all that it includes.
    """
def node_defaults(id: str) -> dict[str, typing.Any]:
    """
    Default values of a node's inputs; those that come from the geometry are left out.
    """
def node_definition(id: str) -> typing.Any:
    """
    The id, category, inputs and outputs (name, MaterialX type) of a node or shading model; None for an unknown one.
    """
def node_ids() -> list[str]:
    """
    Ids of all node definitions and shading models, sorted.
    """
def node_inputs(id: str) -> dict[str, typing.Any]:
    """
    Names and MaterialX types of a node's inputs; empty for an unknown node.
    """
def node_words(id: str) -> dict[str, list[str]]:
    """
    The values that strings of a node may have, where that is a list.
    """
def override_material(network: Network, inputs: dict[str, str]) -> Network:
    """
    The network with inputs replaced, given as text; ValueError names what cannot be.
    """
def partial_description(file: str) -> str:
    """
    The origin of a part, as PartialWriter was told.
    """
def plan_material(network: Network, methods: dict[str, str] = {}, tolerance: float = -1.0) -> dict[str, typing.Any]:
    """
    How the methods of a material are chosen for a tolerance (0: truths, negative: defaults): dict[str, typing.Any] of tolerance, error (relative luminance), albedo, varies, fallback (of displayColor, which is shown in place of the material), and choices.
    """
def read_deep(path: str) -> tuple[typing.Any, ...]:
    """
    Reads a deep image: names of channels, samples by pixel, and their values one after the other; RuntimeError says in one line why not.
    """
def read_image(path: str) -> ImageData:
    """
    Reads any image; RuntimeError says in one line why not.
    """
def read_mtlx(path: str, warnings: typing.Any = None, meters_per_unit: float = 1.0) -> list[Network]:
    """
    The materials of a MaterialX document. Warnings are appended to the list. Distances that have a unit become units of a scene with so many metres in each.
    """
def rendering_space(name: str) -> typing.Any:
    """
    The configuration's spelling of a linear colour space, '' for linear Rec.709, None where light cannot be added in it.
    """
def set_denoiser_library(path: str) -> None:
    """
    Which Open Image Denoise to load; empty for $PATINA_OIDN_LIBRARY or the system's.
    """
def set_limits(values: dict[str, int]) -> str:
    """
    Gives limits of this process values, by their names in base/limits.def; all others have their defaults again, or what the variable PATINA_LIMITS says. Input that was read before stays. Returns an empty text, or why nothing was changed.
    """
def shader_text(path: str) -> str:
    """
    Text of a shader that is compiled in, with its includes; ValueError for others.
    """
def space_primvar(space: str, row: int) -> str:
    """
    The primvar of a row of the matrix into a coordinate system that is bound to a prim. The fourth number of row 3 says from where: 0 the world, 1 the object.
    """
def span_ends(samples: int) -> list[int]:
    """
    After how many samples a frame of so many may be cut; the last is its end.
    """
def tiles_of_part(width: int, height: int, window: typing.Sequence[int] = [0, 0, -1, -1], part: int = 0, parts: int = 1) -> list[Tile]:
    """
    The tiles of one of several parts of an image, from 0.
    """
def translatable_models() -> list[str]:
    ...
def translate_material(network: Network, target: str, warnings: typing.Any = None) -> Network:
    """
    The material as another shading model; a network without terminals where it cannot be.
    """
def unit_factor(unit: str, id: str, input: str, meters_per_unit: float) -> typing.Any:
    """
    What a number in a unit of MaterialX is multiplied by where it is the input of a node with that definition; None for an unknown unit.
    """
def views(display: str) -> list[str]:
    """
    Views of a display, in the order of the configuration.
    """
def web_light_meshes(scene: Scene) -> list[str]:
    """
    Paths of meshes that are lights.
    """
def web_lights(scene: Scene) -> dict[str, typing.Any]:
    """
    lights: (path, floats in the layout of shaders/lights/fields.glsl); table: the values (n, 4) that they point into; domes: dicts of path, texture, radiance, axes and, where the image is no latlong map, pixels of one; warnings: of what is left out.
    """
def web_material(network: Network, methods: dict[str, str] = {}, largest_texture: int = 1024) -> dict[str, typing.Any]:
    """
    A material as GLSL ES 3.00 with what it reads: text, primvars (name, type), textures as arrays of linear texels no larger than largest_texture, lobes, warnings, what was left out.
    """
def web_mesh(scene: Scene, path: str) -> dict[str, typing.Any]:
    """
    Triangles of a prim as arrays with three rows each: points, normals, uv, colors; toWorld as 16 columns. KeyError, or ValueError for a prim without triangles.
    """
def web_shapes(scene: Scene) -> list[typing.Any]:
    """
    (path, material) of the prims that web_mesh() takes.
    """
def whole_shader(text: str) -> str:
    """
    A shader's text with its includes in place, without the functions that it never calls; ValueError for an include that is not compiled in.
    """
def write_image(path: str, pixels: numpy.typing.ArrayLike, channels: list[str] = [], options: dict[str, typing.Any] = {}, metadata: dict[str, typing.Any] = {}) -> None:
    """
    Writes a float array of linear colour.
    """
def write_images(film: Film, path: str, options: dict[str, typing.Any] = {}, metadata: dict[str, typing.Any] = {}) -> None:
    """
    Writes a film: OpenEXR with all its AOVs, or an image for the screen.
    """
ALBEDO_MICROFACET_SIZE: int = 515184
ALBEDO_WARD_TABLE: int = 1058528
STAND_IN_WIDTH: float = 0.004999999888241291
