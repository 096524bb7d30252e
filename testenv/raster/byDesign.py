# SPDX-License-Identifier: Apache-2.0
"""The rasterizer's differences from the path tracer by design: each feature with what it does instead, the test of
the difference itself, and the test scenes that have it (which are then not held together as a whole)."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Feature:
    instead: str
    test: str  # file below testenv/raster, and function
    scenes: tuple = ()


FEATURES = {
    "lightBetweenSurfaces": Feature(
        "no light goes from surface to surface: the path tracer's direct light",
        "test_byDesign.py::test_light_between_surfaces_is_left_out"),
    "mirrors": Feature(
        "mirrors and clear coats show the environment, where nothing hides it, but not the scene",
        "test_byDesign.py::test_mirrors_show_the_environment", ("shaderball",)),
    "hiddenSky": Feature(
        "mirrors and narrow highlights see shadows of the sky in cells that are 17 degrees wide, so the edges of these shadows "
        "are blurred",
        "test_byDesign.py::test_what_hides_the_sky_from_mirrors_is_blurred"),
    "shadowsOfGlass": Feature(
        "light that lobes refract goes straight on, without caustics",
        "test_glassShadows.py::test_a_slab_of_glass_lets_light_through",
        ("roughDielectricSlab", "roughGlass", "media", "caustics")),
    "behindGlass": Feature(
        "surfaces that transmit show the scene behind them, which is more than direct light",
        "test_byDesign.py::test_glass_shows_what_is_behind",
        ("roughDielectricSlab", "roughGlass", "media", "caustics")),
    "subsurface": Feature(
        "subsurface scattering shows as diffuse of its colour",
        "test_byDesign.py::test_subsurface_shows_as_diffuse"),
    "shadowsOfVolumes": Feature(
        "volume prims cast no shadow on surfaces, and their multiple scattering is that of a layer",
        "test_byDesign.py::test_volumes_cast_no_shadow", ("volume",)),
    "lightOfSplats": Feature(
        "Gaussian splats are seen by the camera alone: they cast no shadow, give no light to surfaces, and are in no mirror",
        "test_splatViews.py::test_splats_are_seen_by_the_camera_alone"),
    "shadowsOfLimitedDistance": Feature(
        "shadows of limited distance know only the side of a caster that is nearest to the light",
        "test_byDesign.py::test_shadows_of_limited_distance_know_the_near_side"),
    "seamsOfThinWalls": Feature(
        "in a room of walls without thickness the sky shines onto a strip along the seams, some texels of a shadow map wide",
        "test_byDesign.py::test_a_closed_room_of_thin_walls_is_dark_but_for_its_seams", ("portals",)),
    "dispersion": Feature(
        "all light bends like the d line, 588 nm; a warning names the material",
        "test_dispersionLeftOut.py::test_glass_has_the_ior_of_the_d_line", ("prism",)),
    "motionOfLights": Feature(
        "lights stand still while the shutter is open, at their place in the middle of that time",
        "test_byDesign.py::test_lights_do_not_move_while_the_shutter_is_open"),
    "filtersOfDomes": Feature(
        "harmonics and prefiltered maps of domes show the whole sky, without its light filters, with a warning",
        "test_byDesign.py::test_harmonics_know_no_light_filters"),
    "projections": Feature(
        "a camera shows its plain perspective, without other projections, distortion and pairs of eyes, with a warning",
        "test_byDesign.py::test_cameras_of_other_projections_are_plain", ("fisheye",)),
    "catchers": Feature(
        "catchers of shadows and reflections show as plain surfaces, with a warning",
        "test_byDesign.py::test_catchers_are_plain", ("catchers",)),
}
SCENES = {scene: [name for name, feature in FEATURES.items() if scene in feature.scenes]
          for feature in FEATURES.values() for scene in feature.scenes}
