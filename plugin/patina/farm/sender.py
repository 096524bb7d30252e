# SPDX-License-Identifier: Apache-2.0
"""Sends tasks to workers, sends those that fail elsewhere, and merges frames as their parts come in."""
import collections
import dataclasses
import queue
import time
from concurrent.futures import CancelledError

from patina.cli.errors import is_temporary
from patina.farm import identity, work, worker

LOOK_SECONDS = 1.0  # so often it is seen whether more workers have come
REFUSALS = 20  # of one task, by workers that came later


@dataclasses.dataclass
class Row:
    """The work that a worker has done."""
    host: str = ""
    tasks: int = 0
    seconds: float = 0.0
    failures: int = 0
    losses: int = 0  # times that it went away while there was something to do


class Sender:
    """One job. Knows nothing of Dask but a client that submits functions.

    As many tasks are sent as there are workers: when a worker dies, Dask blames all that waits for it there."""

    def __init__(self, client, arguments, folder, checks, threads):
        """:param arguments: of `patina record` for all frames
        :param folder: that they are meant in
        :param checks: of worker.check()
        :param threads: that a part takes; 0: all of the worker's machine"""
        self.client = client
        self.ended = queue.Queue()  # futures
        self.arguments, self.folder, self.checks, self.threads = arguments, folder, checks, threads
        self.variables = identity.environment()
        self.tasks = {}  # future -> task
        self.failed = []  # tasks that were given up
        self.lost = ""  # why there is no scheduler any more
        self.refusals = []  # why workers were refused, each once
        self.refused = set()  # their addresses
        self.rows = collections.defaultdict(Row)  # by workers' names
        self.names = {}  # worker's address -> name
        self._seen = float("-inf"), []  # when, and the workers' addresses
        self.gone = []  # names of workers that went away, each time
        self.written = []  # frames whose images are there
        self.done = self.total = self.count = 0  # tasks, and workers
        self.times = []  # (kind, seconds) of each task

    def run(self, frames, waiting, report):
        """:param frames: list of work.Frame, in their order
        :param waiting: tasks that can begin
        :param report: called with this now and then"""
        left = collections.deque(waiting)
        self.total = sum(frame.left + 1 if frame.cut.parts > 1 else 1 for frame in frames)
        while left or self.tasks:
            try:
                self._step(left, report)
            except (OSError, RuntimeError, TimeoutError, CancelledError) as error:
                # Tasks end by themselves as failures: this is of the scheduler, or of the way to it.
                self.lost = f"the scheduler is lost ({_words(error)})"
                return

    def _step(self, left, report):
        self._fill(left)
        report(self)
        try:
            future = self.ended.get(timeout=LOOK_SECONDS)
        except queue.Empty:
            return
        follows = self._ended(self.tasks.pop(future), future)
        if follows:
            left.appendleft(follows)

    def _fill(self, left):
        workers = [address for address in self._workers() if address not in self.refused]
        self.count = len(workers)
        while left and len(self.tasks) < max(1, self.count):
            task = left.popleft()
            future = self._submit(task, workers)
            self.tasks[future] = task
            future.add_done_callback(self.ended.put)

    def _submit(self, task, workers):
        # Of those alone that are there: once all others have gone, Dask leaves a task that names them without a worker.
        avoided = self.refused.union(address for address, _ in task.failures).intersection(self._seen[1])
        others = [address for address in workers if address not in avoided]
        # Any worker takes it when those have gone.
        places = {"workers": others, "allow_other_workers": True} if avoided and others else {}
        return self.client.submit(worker.run, task.arguments(self.arguments, self.threads), self.folder, task.log, self.checks,
                                  self.variables, task.frame.user, pure=False, retries=0, **places)

    @property
    def present(self):
        """how many workers there are, those that were refused included"""
        return len(self._seen[1])

    def _workers(self):
        """:returns: addresses of the workers that are there, as they were a moment ago"""
        if time.monotonic() - self._seen[0] > LOOK_SECONDS:
            found = self.client.scheduler_info(n_workers=-1)["workers"]
            for address in self._seen[1]:
                if address not in found:
                    self._gone(address)
            self._seen = time.monotonic(), list(found)
            self.names.update((address, str(one.get("name", address))) for address, one in found.items())
        return self._seen[1]

    def _gone(self, address):
        name = self.names[address]
        self.rows[name].losses += 1
        self.gone.append(name)

    def _ended(self, task, future):
        """:returns: the task that follows: the same once more, the merge of its frame, or None"""
        error = future.exception()
        if error is not None:
            return self._failure(task, error)
        result = future.result()
        row = self.rows[result["worker"]]
        row.host, row.tasks, row.seconds = result["host"], row.tasks + 1, row.seconds + result["seconds"]
        self.times.append(("part" if task.part else "image", result["seconds"]))
        self.done += 1
        frame = task.frame
        if not task.part:
            frame.tidy()
            self.written.append(frame)
            return None
        frame.left -= 1
        return work.Task(frame, None) if frame.left == 0 else None

    def _failure(self, task, error):
        """:returns: the task, where it is tried again"""
        kind = type(error).__name__
        if kind in ("PartFailed", "Refused"):  # a worker of another version may tell less
            reason, address, task.passing = (*(error.args or [_words(error)]), "", False)[:3]
        else:  # Dask tells of workers that went away
            reason, address, task.passing = _words(error), _last_worker(error), kind == "KilledWorker" or is_temporary(error)
        if kind == "Refused":
            task.refusals += 1
            if address not in self.refused:
                self.refused.add(address)
                self.refusals.append(reason)
            again = task.refusals < REFUSALS and any(one not in self.refused for one in self._workers())
        else:
            self.rows[self.names.get(address, address or "unknown")].failures += 1
            if kind == "KilledWorker":
                task.losses += 1
            own = len(task.failures) + 1 - task.losses - task.refusals
            again = task.losses < work.LOSSES and own < work.TRIES
        task.failures.append((address, reason))
        if again:
            return task
        self.failed.append(task)
        return None


def _words(error):
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _last_worker(error):
    """:returns: the address of the worker that went away with the task, where Dask tells it"""
    return getattr(getattr(error, "last_worker", None), "address", "")
