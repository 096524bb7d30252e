# SPDX-License-Identifier: Apache-2.0
"""Renders a stage to images.

  patina record shot.usda shot.png
  patina record shot.usda shot.####.exr --frames 101:110 --samples 256 --aov all
  patina record shot.usda shot.exr --tolerance 0.01 --seconds 600 --json
  patina record shot.usda shot.exr --part 3/8 --partial shot.3.part    an eighth of it, for `patina merge`
  patina record shot.usda --settings /Render/beauty --frames 1:10x3,20    all products of these settings

Warnings are grouped by cause: first where something that was authored is missing and a fallback stands in its place, then where
a default or an approximation is used, the most frequent first, 20 at most. --json has all of them.

Ctrl+C and SIGTERM end a render early: the image is written with the samples so far, IMAGE.checkpoint stays for --resume, and
the command that continues is printed. SIGUSR1 writes a snapshot, and the render goes on. An existing image is replaced only by
a whole one.

Exit status: 0 done, 1 failed with a one-line reason, 2 wrong usage, 75 failed for a reason that may pass (a full disk, memory,
a lost device) or ended by a signal: a scheduler may run the same again, with --resume.
"""
import dataclasses
import functools
import os

from patina.cli import (checkpoints, denoiser, frames, goOn, measuredLevels, openStage, outputs, overrides, planText, products,
                        recordFlags, renderSettings, reports, shots, snapshots, statistics, verbose)
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, TemporaryError
from patina.cli.interrupts import Endings, Interrupts
from patina.cli.progress import Progress
from patina.cli.usd import reader
from patina.farm import partJob

add_arguments = recordFlags.add_arguments
INTERMIXED = True  # IMAGE may be left out


def run(arguments):
    partJob.check(arguments)
    shots.check_usage(arguments)
    recordFlags.check_levels(arguments, "record")
    reports.check_usage(arguments)
    recordFlags.settings_of(arguments)
    recordFlags.purposes_of(arguments)
    overrides.parse(arguments.set)
    job = (partJob.of(_Job) if arguments.part else _Job)(arguments)
    with job.snapshots:
        job.open()
        try:
            for index, shot in enumerate(job.shots):
                job.render(shot)
                left = job.shots[index if job.interrupted else index + 1:]
                if job.told and left:
                    raise job.ended(left)
        finally:
            job.report()


class _Job:
    """One call of the command: a stage, a renderer, one or many films."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.statistics = statistics.Statistics(arguments)
        self.snapshots = snapshots.Snapshots(arguments.snapshot)
        self.told = self.interrupted = False  # to end; so that the last image is not whole
        self.shown_causes = {}  # causes of warnings that were shown ...
        self.reported = 0  # ... and how many warnings there were then
        self._read = None  # (frame, camera, what was read) of the scene
        self.levels, self.tolerance = [], None  # of detail, as they were measured, and what they leave of the tolerance

    def open(self):
        a = self.arguments
        # Before anything slow: will the image have a place to go to?
        if not frames.has_place(os.path.dirname(a.image or "")):
            outputs.need_folders([a.image], a.makeOutputPath)
        outputs.need_folders([a.json, a.report], a.makeOutputPath)
        if a.image:
            _patina.check_image_path(a.image, ["color", "alpha"] + recordFlags.aovs_of(a))
        if a.deep:
            if not a.deep.lower().endswith(".exr"):
                raise CommandError(f"--deep {a.deep}: deep images are OpenEXR (.exr)")
            outputs.need_folders([a.deep], a.makeOutputPath)
        a.denoise = a.denoise or a.denoiseAovs
        if a.denoise:
            denoiser.prepare(_patina)
        outputs.check_all([a.image, a.json, a.report])
        with self.statistics.phase("open"):
            self.stage = openStage.open_stage(a.stage, a.mask, a.sessionLayer, a.layer)
            overrides.apply(self.stage, a.set)
            self.arguments = a = renderSettings.with_pass(a, self.stage)
            prim = renderSettings.SettingsPrim(self.stage, a.settings, getattr(a, "given", ())) if a.settings else None
        if prim:
            self.arguments = a = renderSettings.applied(a, prim)
            partJob.check(a)  # once more: now with what the prim says
            a.denoise = a.denoise or a.denoiseAovs
            if a.denoise:
                denoiser.prepare(_patina)
        self.settings, self.purposes = recordFlags.settings_of(a), recordFlags.purposes_of(a)
        outputs.make_folder(a.outputFolder)
        self.shots = shots.plan(a, self.stage, prim)
        for warning in prim.warnings if prim else ():
            self.statistics.warn(*warning)
        outputs.need_folders([image for shot in self.shots for image in shot.images], a.makeOutputPath)
        for shot in self.shots:
            if not a.image:
                for output in shot.outputs:
                    _patina.check_image_path(output.image, list(output.aovs))
            if shot.deep and a.resume:
                raise CommandError(f"{shot.image}: --resume continues no deep image, since a checkpoint has no depths")
            if shot.deep:
                a.checkpointSeconds = 0.0
        reports.plan(a, self.shots, self.stage)
        self.snapshots.check([image for shot in self.shots for image in shot.images], a.snapshotSuffix)
        for shot in self.shots:
            self._check_outputs(shot)
        self.renderer = _patina.make_renderer(a.backend)
        self.scene = _patina.Scene()

    def render(self, shot):
        self.statistics.begin_frame(shot.frame, shot.images)
        info = self._info(shot)
        self._check_outputs(shot)  # once more: now it is known which textures are read
        self._say_notes(info.notes + self._left_over(shot.image))
        self._check_warnings()
        settings = self._settings(shot, info)
        film = self._film(shot, settings, info)
        if self.arguments.checkpointSeconds > 0.0:
            settings["checkpointFile"] = checkpoints.path_of(shot.image)
        self._render(film, shot, settings, info.camera)
        self._check_warnings()
        if self.arguments.denoise:
            self._denoise(film)
            self._check_warnings()
        with self.statistics.phase("write"):
            self._write(film, shot, settings, info)
        if self.arguments.report:
            with self.statistics.phase("report"):
                problem = reports.write(self, film, shot, settings, info)
            if problem:
                self.statistics.warn(shot.image, "", "reportMissing", shot.page, problem)
                self._check_warnings()
        self.statistics.end_frame()
        if self.arguments.verbose:
            self._say_all(verbose.lines(self.statistics.frames()[-1]))
        elif not self.arguments.quiet:
            Progress("").say(verbose.line(self.statistics.frames()[-1], self.arguments.part and self.arguments.partial))

    def _say_notes(self, notes):
        for note in self.statistics.note(notes):
            Progress("", self.arguments.quiet).say(note)

    def _denoise(self, film):
        with self.statistics.phase("denoise"):
            if denoiser.takes_away(film):
                self.statistics.warn("", "denoise", "pixelsBelowZero")
            left = denoiser.run_where_it_helps(_patina, film, self.statistics.current(), self.arguments.threads,
                                               self.arguments.denoiseAovs)
            self._say_notes([left] if left else [])

    @property
    def _has_checkpoint(self):
        """Whether IMAGE.checkpoint is this render's: otherwise what lies there is left alone."""
        a = self.arguments
        return a.checkpointSeconds > 0.0 or a.keepCheckpoint or a.resume

    def _check_outputs(self, shot):
        a = self.arguments
        files = shot.images + ([snapshots.path_of(image, a.snapshotSuffix) for image in shot.images] if a.snapshot else [])
        outputs.check_all([*files, a.json, shot.page])
        if self._has_checkpoint:
            outputs.check(checkpoints.path_of(shot.image))

    def _left_over(self, image):
        """Files that a killed render has left; they go when this image is written."""
        path = checkpoints.path_of(image)
        if self.arguments.resume or not self._has_checkpoint or not os.path.isfile(path):
            return []
        return [f"{path} of an earlier render is given up (--resume would have continued it)"]

    def _info(self, shot):
        """:returns: what the reader reported; the scene holds the shot's frame as its camera sees it"""
        moment = (shot.frame, self._blurs(shot))
        if self._read is None or self._read[0] != moment or not self._also_from(shot.camera):
            with self.statistics.phase("translate"):
                self._read = (moment, shot.camera, self._translate(shot))
        info = self._read[2]
        return info if shot.camera == self._read[1] else dataclasses.replace(info, camera=shot.camera)

    def _also_from(self, camera):
        """:returns: whether what was read looks as it would for another camera of the same frame: with an equal shutter, and
            without a headlight or levels of detail"""
        (frame, blurs), read_for, info = self._read
        if camera == read_for:
            return True
        if info.headlight or info.uses_camera or self.levels or camera not in info.cameras:
            return False
        prim = self.stage.GetPrimAtPath(camera)
        return not blurs or all((products.prim_value(prim.GetAttribute("shutter:" + end), frame) or 0.0) == time
                   for end, time in zip(("open", "close"), info.shutter))

    def _blurs(self, shot):
        return dict(self.settings, **shot.settings)["enableMotionBlur"]

    def _translate(self, shot):
        wanted = [aov for shot in self.shots for aov in shot.aovs()]
        options = reader.StageOptions(
            frame=shot.frame, purposes=self.purposes, default_purpose="default" in self.purposes,
            complexity=self.arguments.complexity, camera=shot.camera,
            shutter=None if self._blurs(shot) else (0.0, 0.0), headlight=not self.arguments.disableCameraLight,
            motion=any(aov.startswith("motion") for aov in wanted),
            render_pass=self.arguments.renderPassPrimPath, rendering_color_space=self.arguments.renderingColorSpace,
            material_purpose=getattr(self.arguments, "materialPurpose", "full"),
            matte_names=any(aov.startswith("crypto") for aov in wanted))
        if self.arguments.levels == "measured":
            options = self._measured(shot, options)
        with self.scene.edit() as edit:
            edit.clear()
            return reader.read_stage(self.stage, edit, options)

    def _measured(self, shot, options):
        """:returns: the options with levels of detail by their errors"""
        settings = dict(self.settings, **shot.settings)
        self.levels, self.tolerance = measuredLevels.choose(
            self.stage, options, lambda camera: shots.size_of(shot, camera, settings["pixelAspectRatio"]),
            settings["tolerance"])
        self.statistics.current()["levels"] = [dataclasses.asdict(root) for root in self.levels]
        if self.arguments.verbose:
            self._say_all(planText.level_lines(self.levels))
        return dataclasses.replace(options, levels={root.path: root.chosen for root in self.levels})

    def _settings(self, shot, info):
        """:returns: dict of the render settings of a shot"""
        settings = dict(self.settings, **shot.settings)
        if self.levels:
            settings["tolerance"] = self.tolerance  # levels have taken the rest
        guides = denoiser.aovs(settings, self.arguments.backend) if self.arguments.denoise else ()
        wanted = dict.fromkeys([*shot.aovs(), *guides, *(reports.AOVS if self.arguments.report else ())])
        camera = self.scene.camera(info.camera)
        size = shots.size_of(shot, camera, settings["pixelAspectRatio"])
        shots.place(settings, size, camera, functools.partial(self.statistics.warn, shot.prim))
        settings.update(aovs=list(wanted), timeMaterials=bool(self.arguments.report), deep=shot.deep,
                        seed=recordFlags.seed_of(self.arguments, settings["seed"], shot.frame))
        return settings

    def _film(self, shot, settings, info):
        """:returns: an empty film, or that of a checkpoint"""
        film = _patina.Film()
        others = [info.camera, shot.frame, self.purposes, self.arguments.complexity, self.arguments.mask, self.arguments.set,
                  self.arguments.renderPassPrimPath, [root.chosen for root in self.levels]]
        token = checkpoints.token(self.stage, settings, others, self.renderer.progress()["backend"])
        if self.arguments.resume:
            problem = checkpoints.resume(film, checkpoints.path_of(shot.image), token)
            if problem:
                self.statistics.warn(shot.image, "", *problem)
                film = _patina.Film()
        film.resume_token = token
        return film

    def _render(self, film, shot, settings, camera):
        a = self.arguments
        progress = Progress(shot.image, a.quiet)
        Endings.check()  # what a library made of the exception
        self.snapshots.begin(lambda copy: self._write_snapshot(copy, shot, settings, camera))
        with self.statistics.phase("render"), Interrupts() as interrupts:
            self.renderer.start(self.scene, camera, settings, film)
            self._check_warnings()  # of a back end that cannot start
            built = False
            while not self.renderer.wait(0.1) and not interrupts.met:
                state = self.renderer.progress()
                if state["samplesDone"] and not built:
                    built = True
                    self.statistics.built()
                    self._check_warnings()  # of shapes, materials and textures, before the long wait
                if state["samplesDone"]:
                    problem = self.snapshots.look(self.renderer, film)
                    if problem:
                        self.statistics.warn(shot.image, "", *snapshots.message(problem))
                        self._check_warnings()
                progress.show(state)
            self.renderer.stop()
        progress.clear()
        state = self.renderer.progress()
        if state["failed"]:
            raise (TemporaryError if state["temporary"] or state["deviceFailed"] else CommandError)(state["error"])
        self.told = interrupts.met
        self.interrupted = self.told and not state["converged"]
        self.statistics.rendered(state, film)
        if self.interrupted and not film.width:
            raise TemporaryError("interrupted before there were samples; nothing is saved")
        if (self.interrupted and self._has_checkpoint) or a.keepCheckpoint:
            if film.width:
                film.save_checkpoint(checkpoints.path_of(shot.image))
        if self.interrupted and (a.onlyWhole or not state["samplesDone"]):
            raise self.ended(self.shots[self.shots.index(shot):], "interrupted before the image was whole; it is not written")

    def ended(self, left, reason="interrupted"):
        """:param left: shots that are not done
        :returns: the error that ends an interrupted command"""
        if not self.arguments.checkpointSeconds > 0.0:
            return TemporaryError(reason)
        times = list(dict.fromkeys(shot.frame for shot in left))
        return TemporaryError(f"{reason}; --resume continues: {goOn.command(self.arguments, times)}")

    def _write(self, film, shot, settings, info):
        a = self.arguments
        metadata = self.statistics.metadata(a, settings, info.camera)
        for output in shot.outputs:
            if output.deep and not film.has_deep:
                continue  # the back end has said so
            _patina.write_images(film, output.image, shots.image_options(a, shot, output, settings), metadata)
        self.snapshots.remove()
        if self._has_checkpoint and not self.interrupted and not a.keepCheckpoint:
            checkpoints.remove(checkpoints.path_of(shot.image))

    def _write_snapshot(self, film, shot, settings, camera):
        """:param film: a copy, which the render does not touch"""
        if self.arguments.denoise:
            denoiser.run(_patina, film, self.arguments.threads, self.arguments.denoiseAovs)
        metadata = statistics.of_snapshot(self.arguments, film, camera)
        for output in shot.outputs:
            if output.deep:
                continue  # copies of films have no depths
            path = self.snapshots.place_of(output.image, self.arguments.snapshotSuffix)
            _patina.write_images(film, path, shots.image_options(self.arguments, shot, output, settings), metadata)
            self.snapshots.wrote(path)

    def _check_warnings(self):
        """Shows what is new; with --strict the render ends here."""
        self.statistics.collect(self.scene)
        warnings = self.statistics.warnings()
        self._report(warnings)
        if self.arguments.strict and warnings:
            number = f"{len(warnings)} warnings, the worst" if len(warnings) > 1 else "1 warning"
            raise CommandError(f"--strict: {number}: {statistics.Causes(warnings).lines()[0].removeprefix('warning: ')}")

    def _report(self, warnings, last=False):
        fresh, self.reported = len(warnings) != self.reported, len(warnings)
        if not self.arguments.quiet and (fresh or last):
            self._say_all(statistics.Causes(warnings).lines(self.shown_causes, last))

    def _say_all(self, lines):
        for text in lines:
            Progress("").say(text)

    def report(self):
        self._report(self.statistics.warnings(), last=True)
        if self.arguments.json:
            self.statistics.write(self.arguments.json)
