# SPDX-License-Identifier: Apache-2.0
"""`patina record --part`: renders one part of each frame's film and writes its file instead of an image."""
import json
import os

from patina.cli import frames, outputs, shots
from patina.cli.compiled import _patina
from patina.cli.errors import TemporaryError, UsageError
from patina.farm import cut, folders, identity, partial

_REFUSED = (("seconds", "--seconds", "a time limit cuts every part elsewhere"),
            ("resume", "--resume", "a part is rendered whole"),
            ("keepCheckpoint", "--keepCheckpoint", "its file keeps all that it has"),
            ("snapshot", "--snapshot", "a part is no image"),
            ("denoiseAovs", "--denoiseAovs", "merged films have their colour denoised alone"),
            ("deep", "--deep", "its file has no depths"),
            ("report", "--report", "a report is about a whole image"))


def check(arguments):
    """:raises UsageError: where flags do not go together with --part"""
    if bool(arguments.part) != bool(arguments.partial):
        raise UsageError("patina record: --part and --partial go together: which part, and the file for it")
    if not arguments.part:
        return
    for name, flag, why in _REFUSED:
        if getattr(arguments, name):
            raise UsageError(f"patina record: --part with {flag}: {why}")
    if arguments.backend != "embree":
        raise UsageError("patina record: --part is of the path tracer; the rasterizer draws a frame at once")
    if arguments.tolerance > 0.0 and not arguments.samples and arguments.part.cut.ranges > 1:
        raise UsageError("patina record: ranges of samples with --tolerance need --samples, since each takes its samples "
                         "before it is known where tiles stop")
    arguments.checkpointSeconds = 0.0  # parts of one image would share a file


def of(job):
    """:param job: the class of a whole render's job
    :returns: the class of one that renders parts"""

    class PartJob(job):
        def open(self):
            self.typed = self.arguments
            super().open()
            if len(self.shots) != 1 or len(self.shots[0].outputs) != 1:
                raise UsageError("patina record: --part is of one frame and one image")

        def _check_outputs(self, shot):
            folder = os.path.abspath(os.path.dirname(self.arguments.partial))
            outputs.make_folder(folder)
            if folder == os.path.abspath(self.typed.image or "") + ".parts":
                with folders.own(folder):
                    pass  # a job's folder, as `patina farm` takes it
            # The image is checked, too: merging writes it.
            outputs.check_all([*shot.images, self.arguments.partial, self.arguments.json])

        def _render(self, film, shot, settings, camera):
            part = self.arguments.part
            tiles = cut.tiles(settings, part)
            ranges = cut.ranges(_patina.span_ends(settings["samples"]), part.cut.ranges)
            begin, end = ranges[part.range_index]
            self._writer, self._sums = None, {}
            for first, last in self._pieces(settings, begin, end):
                film.resume_token = "part" if first == 0 and self._writer else ""  # it goes on
                super()._render(film, shot, dict(
                    settings, sampleBegin=first, sampleEnd=last, tilePart=part.tile_group, tileParts=part.cut.tiles), camera)
                if self.interrupted:
                    raise TemporaryError(f"interrupted; part {part} is not written")
                if not self._writer:
                    self._writer = _patina.PartialWriter(
                        self.arguments.partial, self._description(shot, settings, camera, (begin, end)), tiles)
                self._writer.add(film)
                partial.add_up(self._sums, self.renderer.progress()["statistics"])
                if film.resolve("sampleCount").max() < last - first:
                    break  # all tiles have stopped

        def _pieces(self, settings, begin, end):
            """:returns: ranges of samples that each make a film: sums from the first sample on, or of one span. With a
            tolerance the image at once may be done wherever a span ends: so far a film from the first sample on is kept"""
            ends = [one for one in _patina.span_ends(settings["samples"]) if begin < one <= end]
            if begin == 0:
                least = max(2, settings["minSamples"]) if settings["tolerance"] > 0.0 else end
                return [(0, one) for one in ends if least <= one < end] + [(0, end)]
            cuts = [begin] + ends
            return list(zip(cuts, cuts[1:]))

        def _description(self, shot, settings, camera, samples):
            a, state = self.arguments, self.renderer.progress()
            others = {"back end": state["backend"], "frame": shot.frame, "cut": str(a.part.cut),
                      "purposes": self.purposes, "complexity": a.complexity, "mask": a.mask, "set": a.set,
                      "material purpose": getattr(a, "materialPurpose", "full"),
                      "camera light": not a.disableCameraLight, "denoise": bool(a.denoise)}
            made = identity.of_render(self.stage, settings, camera, others)
            noise = state["statistics"].get("noiseTolerance", 0.0) if settings["tolerance"] > 0.0 else 0.0
            options = shots.image_options(a, shot, shot.outputs[0], settings)
            return partial.describe(a.part, samples, made, self.typed, options, shot.frame, camera, settings,
                                    noise, folder=os.path.dirname(self.stage.GetRootLayer().realPath), home=os.getcwd(),
                                    denoise=bool(a.denoise),
                                    decimals=frames.times(self.typed, self.stage)[1])

        def _denoise(self, _film):
            """The merged film is denoised, not what a part has of it."""

        def _write_snapshot(self, *_):
            """A part is no image: a signal that asks for one is not heard."""

        def _write(self, film, shot, settings, info):
            state = self.renderer.progress()
            self._writer.commit(json.dumps({
                "statistics": {**state["statistics"], **self._sums}, "plans": state["plans"],
                "sceneChoices": state["sceneChoices"], "backend": state["backend"], "warnings": self.statistics.warnings(),
                "seconds": self.statistics.current()["seconds"]}, default=str))

    return PartJob
