# SPDX-License-Identifier: Apache-2.0
"""Renders frames and parts of them on many workers, by Dask (`distributed`) or as an Open Job Description.

  patina farm shot.usda shot.####.exr --frames 1:240 --cut 4x4 --engine tls://farm --samples 256
  patina farm shot.usda shot.####.exr --frames 1:240 --engine slurm:16 --engineOption queue=render --engineOption cores=8
  patina farm shot.usda shot.####.exr --frames 1:240 --cut 4 --write-job job.yaml

All other flags of `patina record` may be given too, and hold for every frame. A frame that is cut has the bits of the frame
rendered at once. Workers use the sender's paths to the stage, its files and the images. A worker that cannot read or write one
is named before anything is rendered. Parts are kept in IMAGE.parts until the image is written; logs of failed parts stay there.
"""
import argparse
import contextlib
import sys

from patina import inputs, limits
from patina.cli import causes, denoiser, frames, main, openStage, outputs, overrides, recordFlags, renderSettings
from patina.cli.compiled import _patina
from patina.cli.errors import UsageError
from patina.farm import cut, engines, job, jobFiles, jobs, partJob, work

PASSES_ON = True  # to `patina record`
_STAGE, _IMAGE = "\0stage", "\0image"  # no word of a command line holds a zero


def add_arguments(parser):
    parser.usage = "patina farm STAGE IMAGE [--frames SPEC] [--cut TILES[xRANGES]] [--engine ENGINE] [flags of patina record]"
    parser.add_argument("--frames", "-f", metavar="FRAMESPEC", help=frames.FRAMESPEC_HELP)
    parser.add_argument("--cut", type=cut.cut, default=cut.Cut(1), metavar="TILES[xRANGES]",
                        help="cut each frame into so many groups of tiles, and the samples of each into so many ranges "
                             "(default: 1, whole frames)")
    parser.add_argument("--engine", default="local", metavar="ENGINE", help=engines.HELP)
    parser.add_argument("--engineOption", action="append", default=[], metavar="NAME=VALUE",
                        help="an option of Dask's class for the engine (repeatable), such as queue=render, cores=8, "
                             "memory=32GiB, walltime=04:00:00; for pods image=studio/patina and volumes=CLAIM:/PATH; for "
                             "tls:// tls_ca_file, tls_client_cert and tls_client_key")
    parser.add_argument("--threads", type=int, default=None, metavar="N",
                        help="threads of a task (default: the worker's cores)")
    parser.add_argument("--resume", action="store_true", help="leave out images that are there, and parts that fit")
    parser.add_argument("--allowMixed", action="store_true",
                        help="take workers of other builds and instruction sets: images have no defined bits then")
    parser.add_argument("--write-job", metavar="FILE", dest="writeJob",
                        help="write an Open Job Description (2023-09, .yaml or .json) instead: frames, parts and merges as "
                             "steps")
    parser.add_argument("--simulate", metavar="WORKERS[,WORKERS...]",
                        help="after the job, estimate from its times how long so many workers would take")
    parser.add_argument("--json", metavar="FILE", nargs="?", const="-",
                        help="seconds of tasks and workers: --json last to standard output, --json=FILE to a file")
    parser.add_argument("--quiet", "-q", action="store_true", help="errors only")


def run(arguments):
    record = _record_arguments(arguments)
    limits.apply(record.limit)  # the sender opens the stage, too
    engine = engines.parse(arguments.engine, arguments.engineOption)
    counts = _counts(arguments.simulate)
    outputs.check_all([arguments.json, arguments.writeJob])
    recordFlags.settings_of(record)
    recordFlags.purposes_of(record)
    stage = openStage.open_stage(record.stage, record.mask, record.sessionLayer, record.layer)
    _check_render(arguments, _with_prim(record, stage))
    shots = frames.plan(record, stage)
    files, missing = jobFiles.of(_patina, record)
    for file in files:
        inputs.note(file)
    if missing and not arguments.quiet:
        print(f"patina farm: the stage names {causes.printable(missing[0])}, which is not there" +
              (f", and {len(missing) - 1} more such files" if len(missing) > 1 else ""), file=sys.stderr)
    outputs.check_all([arguments.json, arguments.writeJob, *(image for _, image in shots)])
    if arguments.writeJob:
        jobs.write(arguments.writeJob, arguments, record, shots)
        return
    job.Job(engine, arguments, record, shots, files).run(counts)


def _with_prim(record, stage):
    """:returns: the arguments with what --settings says, as each task will have them"""
    if not record.settings and not record.renderPassPrimPath:
        return record
    overrides.apply(stage, record.set)
    record = renderSettings.with_pass(record, stage)
    if not record.settings:
        return record
    return renderSettings.applied(record, renderSettings.SettingsPrim(stage, record.settings, record.given))


def _check_render(arguments, record):
    """Refuses at once all that each task would refuse."""
    if arguments.cut.parts > 1:
        partJob.check(argparse.Namespace(**dict(vars(record), part=cut.Part(1, arguments.cut), partial="part")))
    cut.ranges(_patina.span_ends(recordFlags.settings_of(record)["samples"]), arguments.cut.ranges)
    if record.denoise:
        denoiser.prepare(_patina)


def _record_arguments(arguments):
    """:returns: what `patina record` would have parsed of the flags that are not the farm's own"""
    parser = main._Parser(prog="patina farm")
    recordFlags.add_arguments(parser)
    argv = main._normalise(arguments.passed_on + ([f"--frames={arguments.frames}"] if arguments.frames else []))
    record = parser.parse_intermixed_args(argv)
    record.given = main._given(parser, parser.parse_intermixed_args, argv)
    if not record.image:
        raise UsageError("patina farm: name an IMAGE")
    for name in ("part", "partial", "keepCheckpoint"):
        if getattr(record, name):
            raise UsageError(f"patina farm: the farm sets --{name} itself; leave it out")
    if record.verbose:
        raise UsageError("patina farm: --verbose describes one render; --json has the times of all tasks")
    overrides.parse(record.set)
    _check_task(parser, arguments, argv, record)
    arguments.record_words = _words(parser, arguments.passed_on, record)
    return record


def _check_task(parser, arguments, argv, record):
    """:raises UsageError: where a worker would not understand its command line"""
    frame = work.Frame(None, record.image, arguments.cut, [])
    task = work.Task(frame, frame.parts()[0] if arguments.cut.parts > 1 else None)
    parser.parse_intermixed_args(task.arguments(argv, arguments.threads or 0)[1:])


def _words(parser, passed_on, record):
    """:returns: what was passed on without stage and image, wherever these stand among the flags"""
    words = list(passed_on)
    for name, mark in (("stage", _STAGE), ("image", _IMAGE)):
        for index in [index for index, word in enumerate(words) if word == getattr(record, name)]:
            trial = words[:index] + [mark] + words[index + 1:]
            with contextlib.suppress(UsageError):  # it is the value of a flag that takes no such
                if getattr(parser.parse_intermixed_args(trial), name) == mark:
                    words = trial
                    break
    return [word for word in words if word not in (_STAGE, _IMAGE)]


def _counts(text):
    """:returns: list of numbers of workers to simulate"""
    try:
        counts = [int(word) for word in text.split(",")] if text else []
    except ValueError:
        counts = [0]
    if any(not 1 <= count <= 100000 for count in counts):
        raise UsageError(f"patina farm: --simulate {text}: write numbers of workers, as in 10,100,1000")
    return counts
