# SPDX-License-Identifier: Apache-2.0
"""Which tier and which rooms each test belongs to: the one place that says so.

A test's name is its place: `testenv/cli/test_frames.py::test_x`, or for a suite of a googletest program the folder that its
CMakeLists.txt lies in, `hdDelegate/film::testFilm::Checkpoint`. FOLDERS gives every test below a folder a tier and rooms (the
longest folder counts), so that a new file needs no entry; OVERRIDES, read in order, change either for tests whose names
match a pattern (`*` also matches `/`); the last that says something counts.

COSTLY names what is run first. A test runs in its own tier and in those that hold it (RUNS). Aims, on two quiet cores: unit
30 s, smoke 3 minutes, full 15.
"""
import fnmatch

TIERS = ("lint", "unit", "smoke", "full", "long")
RUNS = {  # --tier: the tiers of the tests that it runs
    "lint": ("lint",),
    "unit": ("lint", "unit"),
    "smoke": ("lint", "unit", "smoke"),
    "full": ("lint", "unit", "smoke", "full"),
    "long": ("long",),
    "all": TIERS,
}
ROOMS = ("base", "shaders", "materialNetwork", "scene", "geometry", "image", "plan", "film", "lights", "compiled", "embree",
         "raster", "backends", "hydra", "python", "stage", "cli", "view", "chart", "farm", "testenv")

FOLDERS = {  # folder: tier, rooms
    "base/": ("unit", "base"),
    "shaders/": ("unit", "shaders"),
    "materialNetwork/": ("unit", "materialNetwork"),
    "hdDelegate/scene/": ("unit", "scene"),
    "hdDelegate/geometry/": ("unit", "geometry"),
    "hdDelegate/image/": ("unit", "image"),
    "hdDelegate/film/": ("unit", "film farm"),
    "hdDelegate/lights/": ("unit", "lights"),
    "hdDelegate/compiled/": ("unit", "compiled"),
    "hdDelegate/embree/": ("smoke", "embree"),
    "hdDelegate/raster/": ("full", "raster"),
    "hdDelegate/backends/": ("smoke", "backends"),
    "hdDelegate/hydra/": ("unit", "hydra"),
    "plugin/patina/stage/": ("smoke", "stage"),
    "plugin/": ("full", "cli"),
    "testenv/bench/": ("full", "testenv"),
    "testenv/cli/": ("full", "cli"),
    "testenv/conformance/": ("full", "testenv hydra cli"),
    "testenv/farm/": ("smoke", "farm cli film"),
    "testenv/film/": ("smoke", "film python"),
    "testenv/fuzz/": ("full", "cli stage materialNetwork film image"),
    "testenv/hydra/": ("full", "hydra"),
    "testenv/mitsuba/": ("long", "embree lights shaders"),
    "testenv/package/": ("long", "python cli backends"),
    "testenv/python/": ("long", "python"),
    "testenv/raster/": ("full", "raster"),
    "testenv/render/": ("full", "embree lights scene geometry image"),
    "testenv/stability/": ("full", "shaders materialNetwork raster"),
    "testenv/tutorials/": ("long", "testenv cli"),
    "testenv/view/": ("full", "view"),
    "testenv/lint/": ("lint", "testenv"),  # reads files that are committed, and renders nothing
    "testenv/tests/": ("unit", "testenv"),
    "testenv/": ("full", "testenv"),
}

OVERRIDES = (  # pattern, tier or None, rooms or None
    ("materialNetwork/tests::testMaterialNetwork::MethodTable", "lint", None),
    # Chi-squared, grids of directions and parameters, agreement of C++ and GLSL.
    ("shaders/tests::testLobeSampling::*", "full", None),
    ("shaders/tests::testLobeAlbedo::*", "smoke", None),
    ("shaders/tests::testLobeDegenerate::*", "smoke", None),
    ("hdDelegate/raster/tests::testGlsl*", "full", "raster shaders materialNetwork"),
    ("hdDelegate/raster/tests::testGlslAgreement::CostlyLobe*", "long", None),
    ("hdDelegate/raster/tests::testGlslMaterial::*", "smoke", None),
    ("hdDelegate/raster/measure/tests::testDomeMethods::*", "full", "raster lights"),
    ("hdDelegate/embree/media/tests::testMedia::*", "smoke", "embree scene"),
    ("hdDelegate/raster/tests::testRaster*", "smoke", None),
    ("hdDelegate/raster/tests::testLightChoice::*", "unit", "raster lights"),
    ("hdDelegate/raster/tests::testProgramCache::*", "smoke", None),
    ("testenv/render/test_besideMaterialX.py::test_materialx_own_examples*", "long", None),
    # Commands and stages: quick, but for what renders or measures.
    ("testenv/cli/*", "smoke", None),
    ("testenv/cli/test_frames.py::*", "unit", None),
    ("testenv/cli/test_overrides.py::*", "unit", None),
    ("testenv/cli/test_usage.py::*", "unit", None),
    ("testenv/cli/test_testRun.py::*", "unit", "cli testenv"),
    ("testenv/cli/test_imageMetrics.py::*", "unit", None),
    ("testenv/cli/test_look.py::*", "unit", "cli chart"),
    ("testenv/cli/test_snapshots.py::test_looking_changes_no_bit[[]raster[]]", "full", "cli raster"),
    ("testenv/cli/test_renderSettings.py::*", "smoke", "cli stage"),
    ("testenv/view/test_report.py::*", "full", "cli view embree"),
    ("testenv/view/test_site.py::*", "long", "view testenv"),
    ("testenv/tutorials/test_blocks.py::*", "smoke", None),
    ("testenv/cli/test_progress.py::*", "unit", None),
    ("plugin/patina/stage/*", "unit", None),
    ("testenv/farm/test_cut.py::*", "unit", None),
    ("testenv/farm/test_simulation.py::*", "unit", None),
    ("testenv/farm/test_work.py::*", "unit", None),
    ("testenv/farm/test_folders.py::*", "unit", None),
    # Processes of Dask and of Open Job Description's command line.
    ("testenv/farm/test_engines.py::*", "full", None),
    ("testenv/farm/test_jobs.py::*", "full", None),
    ("testenv/farm/test_engines.py::test_a_movie_*", "long", None),
    ("testenv/farm/test_queues.py::*", "long", None),
    ("testenv/farm/test_pods.py::*", "full", None),
    ("testenv/farm/test_pods.py::test_pods_are_what_kubernetes_knows", "long", None),
    ("testenv/package/test_everyPackage.py::test_the_page_*", "lint", None),
    ("testenv/package/test_steps.py::*", "full", "view cli"),
    ("testenv/cli/test_chart.py::*", "full", "chart materialNetwork"),
    ("testenv/cli/test_chartScenes.py::*", "full", "chart"),
    ("testenv/cli/test_subdivisionPlan.py::*", "full", "geometry plan materialNetwork"),
    # A quarter of a minute of software OpenGL or more; others of their kind stay.
    ("testenv/raster/test_emitters.py::test_light_follows_cones_of_several_axes[[]narrow[]]", "long", None),
    ("testenv/raster/test_lights.py::test_light_is_the_path_tracers[[]manyDomes[]]", "long", None),
    ("testenv/raster/test_curves.py::test_fibres_of_a_lock_shade_each_other[[]key[]]", "long", None),
    ("testenv/raster/test_lightPlan.py::test_the_cheapest_that_fits_is_taken[[]sky-domeLight[]]", "long", None),
    ("testenv/raster/test_curves.py::test_hair_is_as_wide_and_as_bright_as_traced[[]turn1-0.0003[]]", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]lightDome[]]", "long", None),
    ("testenv/raster/test_lightFilters.py::test_filtered_light_is_the_path_tracers[[]dome[]]", "long", None),
    ("testenv/raster/test_lights.py::test_light_is_the_path_tracers[[]manyLinks[]]", "long", None),
    ("testenv/raster/test_lights.py::test_light_is_the_path_tracers[[]profileNormalized[]]", "long", None),
    ("testenv/raster/test_splatViews.py::test_a_pane_that_does_not_bend_light[[]places[12]-raster[]]", "long", None),
    ("testenv/fuzz/test_faults.py::test_a_render_without_memory_spoils_none_after_it[[]raster-6[]]", "long", None),
    ("testenv/fuzz/test_fuzz.py::test_back_ends_that_differ_are_told", "long", None),
    # As long in the denoiser; others of their kind stay.
    ("testenv/cli/test_denoiseFrames.py::test_error_and_flicker_*", "long", None),
    ("testenv/cli/test_denoisedTolerance.py::test_fewer_samples_*[[]diffuseBox-0.03[]]", "long", None),
    # A minute of software OpenGL; the whole table, measured again.
    ("testenv/cli/test_subdivisionPlan.py::test_the_predicted_error_holds_in_the_rasterizer", "long", None),
    ("testenv/cli/test_chart.py::test_errors_are_those_of_the_table", "long", None),
    ("plugin/patina/library/tests/test_library.py::test_check_passes*", "long", None),
    ("testenv/cli/test_predictions.py::*", "full", "chart materialNetwork"),
    ("testenv/cli/test_check.py::*", "full", "cli materialNetwork shaders"),
    ("testenv/cli/test_bsdf.py::*", "full", "cli materialNetwork raster shaders"),
    ("testenv/cli/test_layers.py::*", None, "cli materialNetwork shaders"),
    ("testenv/stability/test_atlas.py::*", None, "chart shaders"),
    ("testenv/render/test_badInput.py::*", "smoke", "cli stage scene geometry"),
    ("testenv/render/test_features.py::*", "smoke", "embree lights scene geometry stage"),
    ("testenv/render/test_lightUnits.py::*", "smoke", "lights"),
    ("testenv/render/test_mergeSurfaceShaders.py::*", "smoke", "materialNetwork embree"),
    ("testenv/render/test_classicScenes.py::*", "smoke", "shaders materialNetwork"),
    ("testenv/render/test_cryptomatte.py::*", None, "film embree raster stage"),
    ("testenv/render/test_cryptomatte.py::test_a_reader_of_others_*", "long", None),
    ("testenv/render/test_rayMarks.py::*", None, "embree raster stage scene"),
    ("testenv/render/test_furnace.py::*", None, "embree shaders materialNetwork"),
    ("testenv/render/test_furnace.py::test_diffuse_sphere_shows_its_albedo[[]1.0]", "smoke", None),
    ("testenv/render/test_walks.py::*", "smoke", "shaders embree"),
    ("testenv/render/test_reproducible.py::*", None, "embree film backends"),
    ("testenv/raster/test_fallback.py::*", None, "raster backends"),
    # The path of an image is that of an OpenEXR file, which another of these tests goes.
    ("testenv/fuzz/test_faults.py::*[[]png[]]", "long", None),
    ("testenv/fuzz/test_fuzz.py::test_a_minute_of_faults*", "long", None),
    # Every test scene to the noise of thousands of samples.
    ("testenv/render/test_convergence.py::test_error_falls_with_samples*", "long", None),
    ("testenv/tests/test_runner.py::*", "smoke", None),
    ("testenv/raster/test_bothBackEnds.py::*", None, "raster embree lights shaders"),
    ("testenv/raster/test_bothBackEnds.py::test_both_draw_the_same[[]outOfView/rect]", "smoke", None),
    ("testenv/raster/test_bothBackEnds.py::test_both_draw_the_same[[]outOfView/sun]", "smoke", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]Te*", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]teapot*", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]R*", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]B*", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]A*", "long", None),
    # The same locks of fibres under one light after another: one of them tells.
    ("testenv/raster/test_curves.py::test_fibres_of_a_lock_shade_each_other[[]sky[]]", "long", None),
    ("testenv/raster/test_curves.py::test_fibres_of_a_lock_shade_each_other[[]rim[]]", "long", None),
    # Half a minute of compiling shaders in software, for what the choice of sky-domeLight shows too.
    ("testenv/raster/test_lightPlan.py::test_the_cheapest_that_fits_is_taken[[]rect-areaLight[]]", "long", None),
    # Every asset through the older of Hydra's two ways in; the test scenes go through both.
    ("testenv/hydra/test_oneTruth.py::test_asset[[]*-delegate[]]", "long", None),
    # The program usdrecord with the assets that test_oneTruth.py draws in a process of its own; usdview in the older way.
    ("testenv/hydra/test_usdrecord.py::test_asset[[]*", "long", None),
    ("testenv/hydra/test_usdview.py::test_turn_pick_edit[[]delegate[]]", "long", None),
    # A million and a half pixels, as Blender's own screen has them.
    ("testenv/hydra/test_blender.py::test_the_viewport*", "long", None),
    # Half a minute of compiling shaders each, for stages that Hydra's tests draw too.
    *((f"testenv/raster/test_bothBackEnds.py::test_both_draw_the_same[[]assets/{name}[]]", "long", None)
      for name in ("AnimatedCube", "CesiumMan", "InterpolationTest", "Teapot", "axis")),
    # Slow in software, and test_refraction.py looks at the same more closely.
    ("testenv/raster/test_byDesign.py::test_glass_shows_what_is_behind", "long", None),
    ("testenv/raster/test_bothBackEnds.py::test_both_draw_the_same_looked_at_closely*", "long", None),
    # Half a minute of compiling shaders in software each, where a neighbour shows the same: manyDomes, and the filtered sky on
    # the same balls.
    ("testenv/raster/test_lights.py::test_light_is_the_path_tracers[[]twoDomes]", "long", None),
    ("testenv/raster/test_lights.py::test_a_method_of_domes_keeps_the_tolerance_*[[]harmonics-roughConductor]", "long", None),
    # Half a minute of software OpenGL and more, where a neighbour shows the same.
    *((f"testenv/raster/test_bothBackEnds.py::test_both_draw_the_same[[]{name}[]]", "long", None)
      for name in ("curves", "lightDome", "outOfView/glowingMesh", "roughConductor")),
    ("testenv/raster/test_lights.py::test_a_method_of_domes_keeps_the_tolerance_*roughConductor[]]", "long", None),
    ("testenv/raster/test_lights.py::test_what_is_inside_of_a_light_casts_nothing[[]CylinderLight[]]", "long", None),
    ("testenv/raster/test_lights.py::test_wide_suns_are_shadowed_*[[]30[]]", "long", None),
    ("testenv/raster/test_firstPass.py::test_first_looks_continue_as_they_would_have[[]roughConductor[]]", "long", None),
    *((f"testenv/raster/test_manyLights.py::test_choosing_among_just_enough_lights_changes_no_mean[[]{name}[]]", "long", None)
      for name in ("coat", "milk")),
    *((f"testenv/raster/test_whiteSky.py::test_nothing_outshines_a_white_sky[[]{name}-raster[]]", "long", None)
      for name in ("caustics", "classic/hematite", "classic/rustedSteel")),
    # Under a white sky these show the lobes of diffuseBox, texturedDiffuse, roughConductor and roughGlass, which stay; what
    # sets them apart is their lights, which are off, or their cameras and places, which take no part in energy.
    *((f"testenv/raster/test_whiteSky.py::test_nothing_outshines_a_white_sky[[]{name}-raster[]]", "long", None)
      for name in ("catchers", "classic/polishedSteel", "depthOfField", "fisheye", "instanceValues", "instances",
                   "lightFilters", "lightMesh", "lightNegative", "manyLights", "motionBlur", "portals", "prism")),
    # test_no_region_of_the_first_image_is_wrong holds the same images to the same truth, tile by tile.
    *((f"testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]{name}[]]", "long", None)
      for name in ("lightRect", "lightSphere")),
    # A quarter of a minute each, where neighbours show much the same: the atlas' other rows, levels without a tolerance, a
    # board before mirrors, other scenes. The small lamp has no neighbour, and takes half a minute.
    ("testenv/raster/test_emitters.py::test_a_small_lamp_in_view_hides_its_own_far_side", "long", None),
    ("testenv/stability/test_atlas.py::test_bounds_hold_and_failures_show[[]film[]]", "long", None),
    ("testenv/render/test_measuredLevels.py::test_a_larger_tolerance_takes_a_coarser_level_and_roots_share_it", "long", None),
    ("testenv/raster/test_byDesign.py::test_mirrors_show_the_environment", "long", None),
    ("testenv/raster/test_firstPass.py::test_no_region_of_the_first_image_is_wrong[[]instances[]]", "long", None),
    ("testenv/raster/test_manyLights.py::test_choosing_among_just_enough_lights_changes_no_mean[[]mirror[]]", "long", None),
    *((f"testenv/cli/test_denoisedTolerance.py::test_fewer_samples_bring_the_denoised_image_within_the_tolerance[[]{name}[]]",
       "long", None) for name in ("shaderball-0.05", "hair-0.06")),
    ("testenv/render/test_furnace.py::test_diffuse_sphere_shows_its_albedo[[]0.5[]]", "long", None),
    # Each light of manyLinks is linked to one prim, too.
    ("testenv/raster/test_lights.py::test_light_is_the_path_tracers[[]lightLink[]]", "long", None),
    # An inclined cone is a cone. A mesh light goes the way of a glowing mesh, which stays at these places.
    ("testenv/raster/test_emitters.py::test_light_follows_the_direction_that_an_edf_has[[]conical[]]", "long", None),
    *((f"testenv/raster/test_emitters.py::test_emitters_out_of_view[[]meshLight-{where}[]]", "long", None)
      for where in ("behind", "beside")),
    ("testenv/raster/test_byDesign.py::test_harmonics_know_no_light_filters[[]harmonics-False[]]", "long", None),
    ("testenv/raster/test_emitters.py::test_light_follows_the_direction_that_an_edf_has[[]inclinedNarrow[]]", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]classic/hematite[]]", "long", None),
    ("testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last[[]texturedMesh[]]", "long", None),
    ("testenv/raster/test_refraction.py::test_coloured_glass_absorbs_along_the_bent_path[[]0.5[]]", "long", None),
    ("testenv/raster/test_curves.py::test_hair_is_as_wide_and_as_bright_as_traced[[](-20, 170, 0)*", "long", None),
    # A minute of compiling shaders in software; the first of these seeds stays.
    ("testenv/fuzz/test_fuzz.py::test_the_first_seeds[[]faults-4[]]", "long", None),
    # Minutes of a browser's software OpenGL.
    ("testenv/view/test_backEnds.py::test_materials_look_as_in_the_rasterizer[[]all[]]", "long", None),
    ("testenv/view/test_lights.py::test_each_light_is_as_in_the_path_tracer[[]all[]]", "long", None),
    ("testenv/view/test_hostile.py::test_thousands_of_inputs[[]10000[]]", "long", None),
    # One of each kind of filter and of light is enough at a time: these go the ways of the others.
    *((f"testenv/raster/test_lightFilters.py::test_filtered_light_is_the_path_tracers[[]{name}]", "long", None)
      for name in ("barnAnalytic", "barnShear", "cookie", "meshLight", "several", "sun")),
)

# More than about ten seconds of processor time by themselves (not by a fixture that others of their file use too): the first
# that each process runs.
COSTLY = (
    "shaders/tests::testLobeSampling::*",
    "shaders/tests::testLobeAlbedo::LobeAlbedo",
    "shaders/tests::testLobeDegenerate::*",
    "hdDelegate/raster/tests::testGlslAgreement::*",
    "hdDelegate/raster/tests::testGlslMaterial::*",
    "hdDelegate/raster/measure/tests::testDomeMethods::*",
    "testenv/cli/test_chart.py::test_errors_of_pictures_are_those_of_the_table",
    "testenv/cli/test_check.py::test_command",
    "testenv/cli/test_predictions.py::test_renders_tell_the_predicted_error[[]raster]",
    "testenv/raster/test_areaLights.py::test_outlines_keep_*",
    "testenv/raster/test_bothBackEnds.py::test_both_draw_the_same[[]*",
    "testenv/raster/test_firstPass.py::test_the_first_image_looks_like_the_last*",
    "testenv/raster/test_lights.py::test_light_is_the_path_tracers[[]manyDomes]",
    "testenv/raster/test_places.py::test_bumps_of_polygons_stand_in_the_world",
    "testenv/render/test_instanceValues.py::test_the_rasterizer_shows_them_too",
    "testenv/view/test_backEnds.py::*",
    "testenv/view/test_lights.py::test_each_light_*",
    "testenv/fuzz/test_fuzz.py::test_the_first_seeds[[]faults-*",
)


def is_costly(name):
    """:param name: a test's name"""
    return any(fnmatch.fnmatchcase(name, pattern) for pattern in COSTLY)


def place_of(name):
    """:param name: a test's name
    :returns: (tier, frozenset of rooms), or None where no folder holds it"""
    folders = [folder for folder in FOLDERS if (name.partition("::")[0] + "/").startswith(folder)]
    if not folders:
        return None
    tier, rooms = FOLDERS[max(folders, key=len)]
    for pattern, other_tier, other_rooms in OVERRIDES:
        if fnmatch.fnmatchcase(name, pattern):
            tier, rooms = other_tier or tier, other_rooms or rooms
    return tier, frozenset(rooms.split())
