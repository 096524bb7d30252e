# SPDX-License-Identifier: Apache-2.0
"""A job of `patina farm` from the first look at workers to the table at its end."""
import dataclasses
import json
import os
import sys
import time
import uuid

from patina.cli import outputs
from patina.cli.compiled import _patina
from patina.cli.errors import CommandError, TemporaryError
from patina.cli.progress import Progress
from patina.farm import engines, identity, owner, partial, sender, simulation, work, worker

FIRST_WORKER_SECONDS = 600  # a queue may be full
LOOK_SECONDS = 2  # so often it is looked whether the queue has refused
EMPTY_TASKS = 500  # to measure the sender by, for --simulate


class Job:
    """Frames, an engine, and what became of them."""

    def __init__(self, engine, arguments, record, shots, files):
        """:param record: parsed arguments of `patina record`
        :param shots: list of (time code, image)
        :param files: that workers must be able to read"""
        self.engine, self.arguments, self.record = engine, arguments, record
        self.frames = [work.Frame(time_code, image, arguments.cut, self._frame_flags(time_code),
                                  ["--allowMixed"] if arguments.allowMixed else []) for time_code, image in shots]
        machine = identity.of_machine(_patina)
        if arguments.allowMixed:
            machine = {"version": machine["version"]}
        folders = sorted({os.path.dirname(os.path.abspath(frame.image)) for frame in self.frames})
        for frame in self.frames:
            frame.check(files)
        self.name, self.shared = uuid.uuid4().hex, folders[0]
        self.checks = (self.name, files, folders, machine, os.getcwd())
        self.progress = Progress("farm", arguments.quiet)

    def _frame_flags(self, time_code):
        flags = [f"--frames={time_code:.6f}".rstrip("0").rstrip(".")] if self.arguments.frames else []
        # A whole image goes on from its checkpoint.
        return flags + (["--resume"] if self.arguments.resume and self.arguments.cut.parts == 1 else [])

    def run(self, counts):
        """:param counts: numbers of workers to simulate afterwards
        :raises CommandError: where an image is missing at the end"""
        waiting, frames = self._waiting()
        if not waiting:
            self.progress.say("all images are there")
            return
        for frame in frames:
            owner.check(frame.folder, self.name)  # early: workers may be long in coming
        try:
            one, seconds, cost = self._on_workers(frames, waiting, counts)
        finally:
            for frame in frames:
                frame.leave()  # no worker writes a log any more
        self._report(one, frames, seconds, cost, counts)

    def _on_workers(self, frames, waiting, counts):
        """:returns: the Sender that did it, seconds that it took, and those of the sender for a task"""
        with engines.Cluster(self.engine, self.shared) as cluster:
            if cluster.openness():
                self.progress.say(f"warning: {cluster.openness()}")
            self._preflight(cluster)
            self._prepare(frames)
            cost = self._sender_seconds(cluster) if counts else 0.0
            begin, started = time.perf_counter(), time.time()
            threads = engines.threads(self.engine) if self.arguments.threads is None else self.arguments.threads
            one = sender.Sender(cluster.client, self.arguments.passed_on, os.getcwd(), self.checks, threads)
            link = cluster.dashboard()
            if link:  # a narrow terminal shows less of the line of progress
                self.progress.say(f"Dask's page: {link}")
            try:
                one.run(frames, waiting, lambda state: self._look(state, cluster, frames, link))
            except KeyboardInterrupt:
                if one.done or any(frame.kept(started) for frame in frames):
                    raise TemporaryError("interrupted; --resume goes on with what is there") from None
                raise
            finally:
                self._say_losses(one)
                self.progress.clear()
            seconds = time.perf_counter() - begin
        return one, seconds, cost

    def _waiting(self):
        """:returns: the tasks that can begin, and the frames that they are of"""
        waiting, frames = [], []
        for frame in self.frames:
            if self.arguments.resume and os.path.isfile(frame.image):
                frame.tidy_after(self.name)
                continue
            there = set()
            if self.arguments.resume and frame.cut.parts > 1:
                there = work.parts_there(_patina, frame, self._wanted())
            frames.append(frame)
            waiting += frame.tasks(there)
        return waiting, frames

    def _prepare(self, frames):
        """Begins to write: there is a worker that can take a part."""
        for frame in frames:
            frame.prepare(self.name)
        if not self.arguments.resume:
            for frame in frames:
                frame.forget()

    def _wanted(self):
        """:returns: dict of the flags that parts of an earlier job must have been made with"""
        free = ("image", "given", "frames", "threads", "quiet", "json", "resume", "checkpointSeconds")
        flags = {name: value for name, value in partial.plain(self.record).items() if name not in free}
        return json.loads(json.dumps(flags, default=str))  # as the files hold them

    def _preflight(self, cluster):
        """:raises CommandError: where no worker can take a part"""
        client = cluster.client
        if not client.scheduler_info(n_workers=-1)["workers"]:
            self.progress.say(f"waiting for the first worker of {self.arguments.engine}")
        self._wait(cluster)
        found = client.run(worker.check, *self.checks, on_error="return")
        bad, first = 0, ""
        for address, problems in sorted(found.items()):
            if isinstance(problems, Exception):
                problems = [f"{type(problems).__name__}: {problems}"]
            bad += bool(problems)
            if problems:
                first = first or worker.words(problems)
                self.progress.say(f"worker {address} is left out: {worker.words(problems)}")
        if bad == len(found):
            raise CommandError(f"no worker can take a part: {first}")

    def _wait(self, cluster):
        """Until there is a worker."""
        end = time.monotonic() + FIRST_WORKER_SECONDS
        while True:
            try:
                cluster.client.wait_for_workers(1, timeout=LOOK_SECONDS)
                return
            except TimeoutError:
                problem = cluster.problem()
                if problem:
                    raise CommandError(f"no workers of {self.arguments.engine}: {problem}") from None
                if time.monotonic() > end:
                    raise CommandError(f"{self.arguments.engine} has no worker after {FIRST_WORKER_SECONDS} s") from None

    def _look(self, state, cluster, frames, link):
        cluster.replace(state.present)
        self._say_losses(state)
        text = f"{len(state.written)} of {len(frames)} frames, {state.done} of {state.total} tasks, {state.count} workers"
        self.progress.step(state.done, state.total, f"{text}, {link}" if link else text)

    def _say_losses(self, state):
        while state.gone:
            self.progress.say(f"worker {state.gone.pop(0)} went away; what it was rendering is sent again")

    def _sender_seconds(self, cluster):
        """:returns: seconds that the sender and the scheduler are busy for a task: processor time where both are this process,
        else what a task that does nothing takes in a row of them"""
        clock = time.perf_counter if self.engine.kind == "dask" else time.process_time
        begin = clock()
        cluster.client.gather([cluster.client.submit(worker.nothing, pure=False) for _ in range(EMPTY_TASKS)])
        return (clock() - begin) / EMPTY_TASKS

    def _report(self, one, frames, seconds, cost, counts):
        written = one.written
        for reason in one.refusals:
            self.progress.say(f"a worker was left out: {reason}")
        lines = table(one, seconds)
        simulated = []
        if counts and written:
            costs = simulation.Costs(tuple(s for kind, s in one.times if kind == "part"),
                                     tuple(s for kind, s in one.times if kind == "image"), cost)
            simulated = simulation.table(costs, len(frames), self.arguments.cut.parts, counts)
        taken = outputs.write_json(self.arguments.json, {
            "seconds": seconds, "senderSecondsPerTask": cost or None, "frames": len(written), "parts": self.arguments.cut.parts,
            "tasks": [{"kind": kind, "seconds": spent} for kind, spent in one.times],
            "workers": {name: dataclasses.asdict(row) for name, row in one.rows.items()},
            "failed": [{"task": str(task), "reasons": [why for _, why in task.failures]} for task in one.failed],
            "simulated": simulated})
        if not self.arguments.quiet and not taken:
            for line in lines + simulated:
                print(line)
        for task in one.failed:
            print(f"patina: {task}: {task.failures[-1][1]}", file=sys.stderr)
        lost = len(frames) - len(written)
        if lost:
            kind = TemporaryError if one.lost or all(task.passing for task in one.failed) else CommandError
            raise kind((f"{one.lost}; " if one.lost else "")
                       + f"{lost} of {len(frames)} images are not written; --resume goes on with what is there")


def table(one, seconds):
    """:returns: lines: what each worker did"""
    rows = sorted(one.rows.items())
    name = max([6] + [len(worker_name) for worker_name, _ in rows])
    host = max([4] + [len(row.host) for _, row in rows])
    lines = [f"{'worker':<{name}}  {'host':<{host}}{'tasks':>8}{'seconds':>10}{'a task':>9}{'busy':>7}{'failed':>8}{'lost':>6}"]

    def line(worker_name, row, busy):
        return (f"{worker_name:<{name}}  {row.host:<{host}}{row.tasks:>8}{row.seconds:>10.1f}"
                f"{row.seconds / max(row.tasks, 1):>9.2f}{busy:>7.0%}{row.failures:>8}{row.losses:>6}")

    lines += [line(worker_name, row, row.seconds / max(seconds, 1e-9)) for worker_name, row in rows]
    every = sender.Row("", one.done, sum(row.seconds for _, row in rows), sum(row.failures for _, row in rows),
                       sum(row.losses for _, row in rows))
    busy = every.seconds / max(seconds * len(rows), 1e-9)
    return lines + [line("all", every, busy) + f"   in {seconds:.1f} s"]
