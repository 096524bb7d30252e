# SPDX-License-Identifier: Apache-2.0
"""The gain of more workers: the events of a farm on paper, by the measured seconds of a part, a merge and the sender.

The sender and Dask's scheduler are one server: every task waits for it once when it is sent and once when it is done. A worker
takes the next task that was sent to it. A frame's merge follows its last part.
"""
import collections
import heapq
import random
from dataclasses import dataclass


@dataclass(frozen=True)
class Costs:
    """Measured times in seconds."""
    parts: tuple  # of single parts; each task takes one of them by chance
    merges: tuple  # of merges, or of images that were not cut
    sender: float  # that the sender and the scheduler are busy for one task


@dataclass(frozen=True)
class Outcome:
    workers: int
    seconds: float  # until the last image is there
    busy: float  # share of the workers' time that is spent in tasks
    sender_busy: float  # share of the time that the sender is busy
    first: float  # seconds until the first image is there


def run(costs, frames, parts, workers, seed=0):
    """:param frames: of the job
    :param parts: of each frame; 1: it is not cut
    :returns: Outcome"""
    chance = random.Random(seed)
    waiting = collections.deque((frame, part) for frame in range(frames) for part in range(parts if parts > 1 else 0))
    if parts == 1:
        waiting = collections.deque((frame, None) for frame in range(frames))
    left = [parts] * frames
    events = []  # (seconds, order, kind, task)
    ready = collections.deque()  # tasks that were sent and wait for a worker
    free, order, now = workers, 0, 0.0
    sender_until = sender_spent = spent = first = 0.0
    outstanding = 0

    def serve(kind, task):
        """The one server takes the next event behind those before it."""
        nonlocal sender_until, sender_spent, order
        sender_until = max(sender_until, now) + 0.5 * costs.sender
        sender_spent += 0.5 * costs.sender
        order += 1
        heapq.heappush(events, (sender_until, order, kind, task))

    def send():
        nonlocal outstanding
        while waiting and outstanding < workers:
            outstanding += 1
            serve("sent", waiting.popleft())

    def start():
        nonlocal free, spent, order
        while free and ready:
            task = ready.popleft()
            seconds = chance.choice(costs.merges if task[1] is None else costs.parts)
            free -= 1
            spent += seconds
            order += 1
            heapq.heappush(events, (now + seconds, order, "worked", task))

    send()
    while events:
        now, _, kind, task = heapq.heappop(events)
        if kind == "sent":
            ready.append(task)
        elif kind == "worked":
            free += 1
            serve("reported", task)
        else:
            outstanding -= 1
            if task[1] is None:
                first = first or now
            else:
                left[task[0]] -= 1
                if left[task[0]] == 0:
                    waiting.appendleft((task[0], None))
            send()
        start()
    return Outcome(workers, now, spent / (now * workers), sender_spent / now, first)


def limit(costs, parts):
    """:returns: how many workers keep the sender busy all the time: more of them give nothing"""
    tasks = parts + 1 if parts > 1 else 1
    work = (parts * _mean(costs.parts) if parts > 1 else 0.0) + _mean(costs.merges)
    return work / (tasks * costs.sender)


def _mean(values):
    return sum(values) / len(values)


def table(costs, frames, parts, counts):
    """:returns: lines of text"""
    base = None
    lines = [f"{frames} frames of {parts} part{'s' if parts > 1 else ''}: {_mean(costs.parts or costs.merges):.2f} s a part, "
             f"{_mean(costs.merges):.2f} s a merge, {1e3 * costs.sender:.2f} ms of the sender a task"
             if parts > 1 else
             f"{frames} frames: {_mean(costs.merges):.2f} s each, {1e3 * costs.sender:.2f} ms of the sender a task",
             f"{'workers':>8}{'seconds':>12}{'speed':>9}{'busy':>8}{'sender busy':>13}{'first image':>13}"]
    for workers in counts:
        one = run(costs, frames, parts, workers)
        base = base or run(costs, frames, parts, 1).seconds
        lines.append(f"{workers:>8}{one.seconds:>12.1f}{base / one.seconds:>8.1f}x{one.busy:>8.0%}{one.sender_busy:>13.0%}"
                     f"{one.first:>11.1f} s")
    lines.append(f"The sender is busy all the time from {limit(costs, parts):.0f} workers on.")
    return lines
