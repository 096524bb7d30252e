# SPDX-License-Identifier: Apache-2.0
"""Which renders of a stage a chart needs, within the time that it may take."""
import statistics
import time
from dataclasses import dataclass, field

from patina.chart import machine, sceneMeasures, sceneReference
from patina.chart.sceneRenders import BACKENDS, DENOISED, WORDS, OutOfTime, StageRenders
from patina.cli.errors import CommandError

FACTOR = 4          # from one count of samples to the next
MIN_SAMPLES = 16    # samples that renders to a tolerance take in any case
SHORT, REPEATS = 1.0, 3  # renders below so many seconds are repeated


@dataclass
class Rung:
    """Renders of one setting; each repeat has a seed of its own."""
    backend: str
    samples: float    # asked for; of a tolerance: those that were taken, mean per pixel
    tolerance: float  # 0: none
    met: bool         # of a tolerance: whether it was reached
    renders: list

    @property
    def seconds(self):
        return statistics.median(r.seconds for r in self.renders)

    @property
    def busy(self):
        return statistics.median(r.busy for r in self.renders)


@dataclass
class Ladder:
    renders: StageRenders
    rungs: list = field(default_factory=list)
    first: dict = field(default_factory=dict)       # back end -> seconds of a first frame beyond a warm one
    references: dict = field(default_factory=dict)  # "all", "direct" -> Reference
    notes: list = field(default_factory=list)       # what was left out and why
    problems: list = field(default_factory=list)    # of these the command's exit status is 1

    def of(self, backend, tolerances=False):
        return [r for r in self.rungs if r.backend == backend and (r.tolerance > 0.0) == tolerances]

    def seconds_in_all(self, rung):
        """Seconds of a first render: reading the stage, building scene and shaders, sampling."""
        return self.renders.seconds_to_read + self.first[rung.backend] + rung.seconds


def counts(maximum):
    """1, 4, 16, ... and the most itself where it is none of these."""
    found = [1]
    while found[-1] * FACTOR <= maximum:
        found.append(found[-1] * FACTOR)
    return found + ([maximum] if found[-1] < maximum else [])


def climb(path, arguments, methods, truth, folder, say):
    """Renders everything of one stage.

    :param methods: choice point -> method of the tested renders
    :param truth: those of the reference
    :param folder: where references are kept; none if empty
    :param say: is told, in a line, what is rendered
    :raises CommandError, StageError: where nothing can be charted
    """
    begin = time.perf_counter()
    deadline = begin + arguments.seconds if arguments.seconds > 0.0 else None
    ladder = Ladder(StageRenders(path, arguments, deadline))
    backends = list(BACKENDS) if arguments.backend == "both" else [arguments.backend]
    if arguments.denoise and "embree" in backends:
        backends.insert(1, DENOISED)
    climber = _Climber(ladder, methods, truth, folder, say)
    try:
        for backend in list(backends):
            try:
                climber.warm_up(backend)
            except CommandError as error:
                if len(backends) == 1:
                    raise
                backends.remove(backend)
                ladder.problems.append(str(error))
        if deadline:
            climber.rate()
        climber.steps(backends)
        climber.tolerances(backends)
        climber.references(backends)
        climber.look_for_other_work()
    except OutOfTime:
        raise CommandError(f"--seconds {arguments.seconds:g} is too short for one sample and a reference") from None
    return ladder


class _Climber:
    def __init__(self, ladder, methods, truth, folder, say):
        self.ladder, self.renders = ladder, ladder.renders
        self.arguments = self.renders.arguments
        self.methods, self.truth, self.folder, self.say = methods, truth, folder, say
        self.per_sample = {}  # back end -> seconds
        self.of_reference, self.of_errors = 0.0, 0.0  # seconds of one of its samples, and of comparing; if time is short

    def settings(self, samples, step, repeat, tolerance=None):
        # Every render has noise of its own, or points of a chart would err together.
        return self.renders.settings(samples, self.arguments.seed + 16 * step + repeat, tolerance, methods=self.methods)

    def warm_up(self, backend):
        """A first frame, which builds the scene and the shaders, and one more to tell what it cost beyond its sample."""
        self.say(f"{WORDS[backend]}: first frame")
        first = self.renders.render(backend, self.settings(1, 0, 0))
        warm = self.renders.render(backend, self.settings(1, 0, 0))
        self.ladder.first[backend] = max(0.0, first.wall - warm.seconds)
        self.per_sample[backend] = warm.seconds

    def rate(self):
        """How fast the path tracer makes the reference, with the most exact methods, and images are compared."""
        settings = self.renders.settings(4, 0, 0.0, methods=self.truth)
        self.renders.render("embree", settings)
        found = self.renders.render("embree", settings)
        self.of_reference = found.seconds / 4
        begin = time.perf_counter()
        sceneMeasures.errors(found.image, found.image)
        self.of_errors = time.perf_counter() - begin

    def comparing(self, more=0):
        """Seconds that errors of all renders and some more will take: the rasterizer's are compared twice."""
        return self.of_errors * (more + sum(1 + (r.backend == "raster") for r in self.ladder.rungs))

    def reserve(self, samples, backends):
        """Seconds that references need for so many samples."""
        if self.arguments.reference:
            return 0.0
        asked = self.arguments.referenceSamples or sceneReference.SAMPLES_FACTOR * samples
        return asked * self.of_reference * (2.0 if "raster" in backends else 1.0)

    def fits(self, seconds, samples, backends):
        left = self.renders.left()
        return left is None or seconds + self.reserve(samples, backends) + self.comparing(more=2) < left

    def steps(self, backends):
        """All counts of samples; a back end that would take too long stops, the other goes on."""
        climbing = list(backends)
        for step, samples in enumerate(counts(self.arguments.maxSamples)):
            for backend in list(climbing):
                wanted = self.per_sample[backend] * samples
                wanted *= REPEATS if wanted < SHORT else 1
                # References are of the samples of the back end that goes on longest.
                if step and not self.fits(wanted, samples, backends):
                    self.note(f"{WORDS[backend]}: stopped before {samples} samples, --seconds {self.arguments.seconds:g} "
                              "would not do")
                    climbing.remove(backend)
                    continue
                try:
                    self.per_sample[backend] = self.rung(backend, samples, step).seconds / samples
                except OutOfTime:
                    if not step:
                        raise
                    self.note(f"{WORDS[backend]}: {samples} samples were given up, --seconds {self.arguments.seconds:g} are "
                              "over")
                    return

    def rung(self, backend, samples, step, tolerance=None):
        what = f"to a tolerance of {tolerance:g}" if tolerance else f"{samples} sample" + "s" * (samples > 1)
        self.say(f"{WORDS[backend]}: {what}")
        made = []
        while not made or (len(made) < REPEATS and made[0].seconds < SHORT):
            try:
                made.append(self.renders.render(backend, self.settings(samples, step, len(made), tolerance)))
            except OutOfTime:
                if made:
                    break
                raise
        met = not tolerance or all(r.maximum < samples for r in made)  # no pixel stopped for want of samples
        taken = statistics.mean(r.samples for r in made) if tolerance else samples
        rung = Rung(backend, taken, tolerance or 0.0, met, made)
        self.ladder.rungs.append(rung)
        return rung

    def tolerances(self, backends):
        maximum = max(int(r.samples) for r in self.ladder.rungs)
        if self.arguments.tolerances and maximum <= MIN_SAMPLES:
            self.note(f"no tolerances: these take at least {MIN_SAMPLES} samples, and {maximum} are the most that were taken")
            return
        for backend in backends:
            for tolerance in self.arguments.tolerances:
                self.tolerance(backend, tolerance, maximum)

    def tolerance(self, backend, tolerance, maximum):
        if not self.fits(self.per_sample[backend] * maximum, maximum, [backend]):
            self.note(f"{WORDS[backend]}: tolerance {tolerance:g} left out, --seconds {self.arguments.seconds:g} would not do")
            return
        step = 1000 + self.arguments.tolerances.index(tolerance)
        try:
            # Other methods are other shaders, which drivers compile in the first frame.
            self.renders.render(backend, self.settings(1, step, 0, tolerance))
            rung = self.rung(backend, maximum, step, tolerance)
        except OutOfTime:
            self.note(f"{WORDS[backend]}: tolerance {tolerance:g} was given up, --seconds {self.arguments.seconds:g} are over")
            return
        if not rung.met:
            self.note(f"{WORDS[backend]}: tolerance {tolerance:g} was not met by {maximum} samples everywhere (--maxSamples)")

    def references(self, backends):
        a = self.arguments
        maximum = max(int(r.samples) for r in self.ladder.rungs)
        if self.renders.deadline:
            self.renders.deadline -= self.comparing()
        if a.reference:
            self.ladder.references["all"] = sceneReference.brought(a.reference, self.renders)
            if "raster" not in backends:
                return
        samples = a.referenceSamples or sceneReference.SAMPLES_FACTOR * maximum
        wanted = [] if a.reference else [("all", None)]
        if "raster" in backends:
            wanted.append(("direct", sceneReference.DIRECT))
        for name, depth in wanted:
            self.say(f"reference, {name} light: {samples} samples")
            try:
                found = sceneReference.made(self.renders, self.folder, samples, depth, self.truth)
            except OutOfTime:
                if name == "all":
                    raise
                self.note("no reference of direct light: the time is over")
                continue
            self.ladder.references[name] = found
            if found.samples < sceneReference.SAMPLES_FACTOR * maximum:
                self.note(f"the reference ({name} light) has {found.samples:.0f} samples, fewer than "
                          f"{sceneReference.SAMPLES_FACTOR} times the {maximum} of the finest render: its own noise is part of "
                          "the errors")

    def look_for_other_work(self):
        """Times of a machine that did something else as well say little: notes it."""
        cores = self.arguments.threads or machine.cores()
        slow = [r for r in self.ladder.of("embree") if r.seconds > 0.3 and r.busy < 0.7 * cores]
        if slow:
            worst = min(r.busy for r in slow)
            self.note(f"other work has slowed some renders: the path tracer had as little as {worst:.1f} of {cores} cores "
                      "(column cores)")

    def note(self, text):
        self.ladder.notes.append(text)
        self.say(text)
