"""Renders a stage to images.

  patina record shot.usda shot.png
  patina record shot.usda shot.###.exr --frames 101:110 --samples 256 --aov all
  patina record shot.usda shot.exr --tolerance 0.01 --seconds 600 --json
  patina record shot.usda shot.exr --part 3/8 --partial shot.3.part    an eighth of it, for `patina merge`

Warnings are told by their causes: first errors (something that was authored is missing from the image), then warnings (a
default or an approximation is used), those that are met most often first, 20 at most. --json has all of them.

Ctrl+C ends a render early: the image is written with the samples that are there, and
IMAGE.checkpoint stays for --resume. An image that was there before is replaced only by a whole one.
"""
import os

from patina.cli import checkpoints, compiled, denoiser, frames, openStage, outputs, overrides, recordFlags, statistics
from patina.cli.errors import CommandError
from patina.cli.interrupts import Endings, Interrupts
from patina.cli.progress import Progress
from patina.farm import partJob

add_arguments = recordFlags.add_arguments
DEFAULT_WIDTH = 960


def run(arguments):
    partJob.check(arguments)
    _patina = compiled.load()
    settings = recordFlags.settings_of(arguments)
    purposes = recordFlags.purposes_of(arguments)
    overrides.parse(arguments.set)
    job = (partJob.of(_Job) if arguments.part else _Job)(_patina, arguments, settings, purposes)
    job.open()
    try:
        for frame, image in job.plan:
            job.render(frame, image)
            if job.interrupted:
                break
    finally:
        job.report()
    if job.interrupted:
        raise CommandError("interrupted; --resume continues" if arguments.checkpointSeconds > 0.0 else "interrupted")


class _Job:
    """One call of the command: a stage, a renderer, one or many frames."""

    def __init__(self, module, arguments, settings, purposes):
        self.module, self.arguments, self.settings, self.purposes = module, arguments, settings, purposes
        self.statistics = statistics.Statistics(arguments)
        self.interrupted = False
        self.told = {}  # causes of warnings that were shown ...
        self.reported = 0  # ... and how many warnings there were then

    def open(self):
        a = self.arguments
        pattern = a.image
        # Before anything slow: will the image have a place to go to?
        self.module.check_image_path(pattern, ["color", "alpha"] + recordFlags.aovs_of(a))
        if a.denoise:
            denoiser.prepare(self.module)
        outputs.check_all([pattern, a.json])
        with self.statistics.phase("open"):
            self.stage = openStage.open_stage(a.stage, a.mask, a.sessionLayer)
            overrides.apply(self.stage, a.set)
        self.plan = frames.plan(a, self.stage)
        for _, image in self.plan:
            self._check_outputs(image)
        self.renderer = self.module.make_renderer(a.backend)
        self.scene = self.module.Scene()

    def render(self, frame, image):
        self.statistics.begin_frame(frame, image)
        with self.statistics.phase("translate"):
            info = self._translate(frame)
        self._check_outputs(image)  # once more: now it is known which textures are read
        for note in self.statistics.note(info.notes + self._left_over(image)):
            Progress("", self.arguments.quiet).say(note)
        self._check_warnings()
        settings = dict(self.settings, **self._size(info))
        film = self._film(image, settings, info, frame)
        if self.arguments.checkpointSeconds > 0.0:
            settings["checkpointFile"] = checkpoints.path_of(image)
        self._render(film, image, settings, info.camera)
        self._check_warnings()
        if self.arguments.denoise:
            with self.statistics.phase("denoise"):
                denoiser.run(self.module, film, self.arguments.threads)
        with self.statistics.phase("write"):
            self._write(film, image, settings, info)
        self.statistics.end_frame()

    def _check_outputs(self, image):
        outputs.check_all([image, self.arguments.json])
        if self.arguments.checkpointSeconds > 0.0 or self.arguments.keepCheckpoint or self.arguments.resume:
            outputs.check(checkpoints.path_of(image))

    def _left_over(self, image):
        """What a render that was killed has left; it goes when this image is written."""
        path = checkpoints.path_of(image)
        if self.arguments.resume or not os.path.isfile(path):
            return []
        return [f"{path} of an earlier render is given up (--resume would have continued it)"]

    def _translate(self, frame):
        from patina import stage as reader

        options = reader.StageOptions(
            frame=frame, purposes=self.purposes, complexity=self.arguments.complexity,
            camera=self.arguments.camera, headlight=not self.arguments.disableCameraLight)
        with self.scene.edit() as edit:
            edit.clear()
            return reader.read_stage(self.stage, edit, options)

    def _size(self, info):
        """:returns: dict of width and height: what is not given follows from the camera's aperture"""
        a = self.arguments
        width, height = a.imageWidth, a.imageHeight
        camera = self.scene.camera(info.camera)
        apertures = camera["horizontal_aperture"], camera["vertical_aperture"]
        aspect = apertures[0] / apertures[1] if min(apertures) > 0.0 else 16.0 / 9.0
        aspect /= a.pixelAspectRatio
        if width is None:
            width = DEFAULT_WIDTH if height is None else max(1, round(height * aspect))
        if height is None:
            height = max(1, round(width / aspect))
        if width * height > recordFlags.MAX_PIXELS or max(width, height) > recordFlags.LARGEST_SIZE:
            raise CommandError(f"an image of {width} x {height} pixels is too large")
        return {"width": width, "height": height}

    def _film(self, image, settings, info, frame):
        """:returns: an empty film, or that of a checkpoint"""
        film = self.module.Film()
        token = checkpoints.token(self.stage, settings, [
            info.camera, frame, self.purposes, self.arguments.complexity, self.arguments.mask, self.arguments.set],
            self.renderer.progress()["backend"])
        if self.arguments.resume:
            problem = checkpoints.resume(film, checkpoints.path_of(image), token)
            if problem:
                self.statistics.warn(image, "", problem)
                film = self.module.Film()
        film.resume_token = token
        return film

    def _render(self, film, image, settings, camera):
        a = self.arguments
        progress = Progress(image, a.quiet)
        Endings.check()  # what a library made of the exception
        with self.statistics.phase("render"), Interrupts() as interrupts:
            self.renderer.start(self.scene, camera, settings, film)
            self._check_warnings()  # of a back end that cannot start
            built = False
            while not self.renderer.wait(0.1) and not interrupts.met:
                state = self.renderer.progress()
                if state["samplesDone"] and not built:
                    built = True
                    self._check_warnings()  # of shapes, materials and textures, before the long wait
                progress.show(state)
            self.renderer.stop()
        progress.clear()
        state = self.renderer.progress()
        if state["failed"]:
            raise CommandError(state["error"])
        self.interrupted = interrupts.met and not state["converged"]
        self.statistics.rendered(state, film)
        if self.interrupted or a.keepCheckpoint:
            if film.width:
                film.save_checkpoint(checkpoints.path_of(image))
        if self.interrupted and not state["samplesDone"]:
            raise CommandError("interrupted before the image was whole; it is not written")

    def _write(self, film, image, settings, info):
        a = self.arguments
        options = recordFlags.image_options_of(a)
        self.module.write_images(film, image, options, self.statistics.metadata(a, settings, info.camera))
        if not self.interrupted and not a.keepCheckpoint:
            checkpoints.remove(checkpoints.path_of(image))

    def _check_warnings(self):
        """Shows what is new; with --strict the render ends here."""
        self.statistics.collect(self.scene)
        warnings = self.statistics.warnings()
        self._report(warnings)
        if self.arguments.strict and warnings:
            raise CommandError(f"--strict: {len(warnings)} warnings, the worst: {statistics.lines(warnings)[0]}")

    def _report(self, warnings, last=False):
        fresh, self.reported = len(warnings) != self.reported, len(warnings)
        if not self.arguments.quiet and (fresh or last):
            for text in statistics.Causes(warnings).lines(self.told, last):
                Progress("").say(text)

    def report(self):
        self._report(self.statistics.warnings(), last=True)
        if self.arguments.json:
            self.statistics.write(self.arguments.json)
