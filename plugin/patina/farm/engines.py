# SPDX-License-Identifier: Apache-2.0
"""Engines that run the parts: a Dask cluster that is there, one of this machine, or one that a queue or Kubernetes starts."""
import asyncio
import concurrent.futures
import contextlib
import importlib.util
import json
import logging
import os
import re
import shlex
import signal
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from multiprocessing import resource_tracker

import patina
from patina.cli import interrupts
from patina.cli.errors import CommandError, TemporaryError, UsageError
from patina.farm import certificates, identity, pods

QUEUES = {"slurm": "SLURMCluster", "pbs": "PBSCluster", "lsf": "LSFCluster", "sge": "SGECluster"}
HELP = ("tls://HOST[:PORT] is a Dask scheduler that runs, dask:// one that asks for no certificates; local:N starts "
        "N workers here; slurm:N, pbs:N, lsf:N and sge:N ask a queue for N jobs; k8s:N asks Kubernetes for N pods "
        "(default: local, with two cores or more for each worker)")
PORT = 8786  # Dask's own
_PAGE = "dashboard_address"  # where Dask's own page is
# Lines of a job: a folder that its user alone may enter, while it runs. Dask's own choice is one for all users of a machine.
_FOLDER = ("DASK_TEMPORARY_DIRECTORY=$(mktemp -d) && export DASK_TEMPORARY_DIRECTORY || exit 1",
           """trap 'rm -rf "$DASK_TEMPORARY_DIRECTORY"' EXIT""")
_ENTER = 'cd "$DASK_TEMPORARY_DIRECTORY" || exit 1'  # `python -m` runs modules of the current folder
REPLACE_SECONDS = 15.0  # so often workers are asked for in the place of those that are gone


@dataclass(frozen=True)
class Engine:
    kind: str  # dask, local, k8s or one of QUEUES
    address: str = ""  # of a scheduler
    workers: int = 0  # to start
    options: dict = field(default_factory=dict)  # of the cluster's class


def parse(text, options):
    """:param options: list of NAME=VALUE
    :raises UsageError: where there is no such engine"""
    known = _options(options)
    if text.startswith(("dask://", "tcp://", "tls://")):
        scheme, _, host = text.partition("://")
        if not re.fullmatch(r"(\[[0-9a-fA-F:]+\]|[\w.-]+)(:\d+)?/?", host):
            raise UsageError(f"patina farm: --engine {text}: '{host}' is no host")
        host = host.rstrip("/")
        address = host if re.search(r":\d+$", host) else f"{host}:{PORT}"
        secure = certificates.check(known) or scheme == "tls"
        if secure and scheme == "tcp":
            raise UsageError(f"patina farm: --engine {text}: with certificates write tls:// or dask://")
        return Engine("dask", f"{'tls' if secure else 'tcp'}://{address}", 0, known)
    kind, colon, count = text.partition(":")
    if kind not in ("local", "k8s", *QUEUES) or (colon and not re.fullmatch(r"[1-9]\d{0,4}", count)):
        raise UsageError(f"patina farm: --engine {text}: there is none such ({HELP.partition(' (default')[0]})")
    if kind != "local" and not colon:
        raise UsageError(f"patina farm: --engine {text}: say how many workers, as in {kind}:8")
    if kind == "k8s":
        pods.check(known)
    return Engine(kind, "", int(count) if colon else max(1, (os.cpu_count() or 1) // 2), known)


def _options(texts):
    found = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.isidentifier():
            raise UsageError(f"patina farm: --engineOption {text}: write it as name=value")
        try:
            found[name] = json.loads(value)
        except ValueError:
            found[name] = value
    return found


def threads(engine):
    """:returns: how many threads a part takes; 0: all of its machine"""
    if engine.kind == "local":
        return max(1, (os.cpu_count() or 1) // engine.workers)
    return int(engine.options.get("cores", 1)) if engine.kind in QUEUES else 0


def queue_options(given):
    """:param given: options of --engineOption
    :returns: dict of what dask-jobqueue's class for the queue takes"""
    lines = [f"export {name}={shlex.quote(value)}" for name, value in environment().items()]
    more = given.get("job_script_prologue") or []
    return {"cores": 1, "processes": 1, "memory": "4GiB", "python": shlex.quote(sys.executable),
            # One part at a time, which takes all of a job's cores.
            "worker_extra_args": ["--nthreads", "1", "--no-dashboard"], **given,
            "job_script_prologue": [*lines, *_FOLDER, *([more] if isinstance(more, str) else more), _ENTER]}


class Cluster:
    """The workers of an engine, while the block lasts. Who has not the run's key finds no way to those that it starts."""

    def __init__(self, engine, shared):
        """:param shared: a folder that a queue's jobs reach, too"""
        self.engine, self._shared = engine, shared
        self._cluster = self.client = None
        self._held = contextlib.ExitStack()  # folders of keys and of Dask, and its thread
        self._complaints = _Complaints()
        self._asked = float("-inf")  # when for workers

    def __enter__(self):
        _configure(_PAGE in self.engine.options)
        distributed = _import("distributed", "distributed")
        try:
            if self.engine.kind == "dask":
                security, options = certificates.of_files(distributed, self.engine.options)
                self.client = distributed.Client(self.engine.address, **{"timeout": "30s", "security": security, **options})
            else:
                with interrupts.held():  # Dask closes no cluster that is half made
                    self._cluster = self._start(distributed)
                    self._scale()
                    self.client = distributed.Client(self._cluster)
        except (OSError, RuntimeError, ValueError, TypeError) as error:
            self.__exit__()
            place, first = self.engine.address or self.engine.kind, _first(error)
            # Of a process that ended while it started, Dask tells no reason.
            kind = TemporaryError if self.engine.kind == "local" and isinstance(first, RuntimeError) else CommandError
            said = " ".join(str(first).split()) or type(first).__name__
            if "ssl_context" in said:  # Dask has no certificates, neither from options nor from its configuration
                said = "name certificates: " + " ".join(f"--engineOption {name}=FILE" for name in certificates.FILES)
            raise kind(f"no workers of {place}: {said}") from error
        except BaseException:  # a signal
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for one in (self.client, self._cluster):
            if one is not None:
                # A scheduler that died does not answer, and jobs that were refused are no running ones.
                with contextlib.suppress(OSError, RuntimeError, TimeoutError, AssertionError):
                    one.close()
        self._held.close()

    def problem(self):
        """:returns: why no worker will come, where the queue has taken no job; else an empty text"""
        jobs = list(getattr(self._cluster, "workers", {}).values())
        return "" if any(getattr(job, "job_id", None) for job in jobs) else self._complaints.text

    def replace(self, there):
        """Asks for workers in the place of those that went away: Dask forgets a worker that is away for longer than its setting
        `distributed.deploy.lost-worker-timeout`, and starts no other by itself.

        :param there: how many workers there are"""
        if self._cluster is not None and there < self.engine.workers and time.monotonic() - self._asked >= REPLACE_SECONDS:
            self._scale()

    def openness(self):
        """:returns: who else may run programs on the workers, or an empty text for nobody"""
        if self.engine.address.startswith("tcp:"):
            return (f"{self.engine.address} asks for no certificate: whoever reaches it can run programs as its workers' user "
                    "(docs/farm.md)")
        return ""

    def dashboard(self):
        """:returns: the address of Dask's own page, or an empty text. Of a scheduler that is started here it must be asked for:
            anybody may look at it"""
        asked = self.engine.kind == "dask" or (_PAGE in self.engine.options and importlib.util.find_spec("bokeh"))
        return (getattr(self.client, "dashboard_link", "") or "") if asked else ""

    def _start(self, distributed):
        engine = self.engine
        security = certificates.of_run(distributed)
        options = {name: value for name, value in engine.options.items() if name != _PAGE}
        shared = {"security": security, "silence_logs": logging.CRITICAL, "loop": self._held.enter_context(_loop())}
        page = {"dashboard": _PAGE in engine.options, _PAGE: engine.options.get(_PAGE, "127.0.0.1:0")}
        for name in ("scheduler_kwargs", "scheduler_options"):  # Dask's page must be asked for by its own name
            page = {**(options.pop(name, None) or {}), **page}
        scratch = self._held.enter_context(_own_folder())
        if engine.kind == "local":
            return distributed.LocalCluster(**{
                "n_workers": engine.workers, "threads_per_worker": 1, "processes": True, "memory_limit": 0,
                "local_directory": scratch, "scheduler_kwargs": page, **shared, **options})
        package = "kubernetes" if engine.kind == "k8s" else "dask-jobqueue"
        module = _import(package.replace("-", "_"), package)
        # A queue's reason to refuse a job is told nowhere else.
        for name in ("tornado.application", "asyncio"):
            log = logging.getLogger(name)
            log.handlers, log.propagate = [self._complaints], False
        if engine.kind == "k8s":
            return pods.start(distributed, module, options, environment(), page, shared, self._held)
        given = options.pop("shared_temp_directory", None)  # whose choice it is knows who may write there
        folder = self._held.enter_context(certificates.private_folder(given, checked=False) if given
                                          else certificates.private_folder(self._shared, "~"))
        return getattr(module, QUEUES[engine.kind])(**{"shared_temp_directory": folder, "scheduler_options": page, **shared,
                                                       **queue_options(options)})

    def _scale(self):
        self._asked = time.monotonic()
        workers = getattr(self._cluster, "workers", {})
        for name, one in list(workers.items()):
            # One that was killed while it started is never forgotten by Dask.
            if getattr(getattr(one, "status", None), "name", "") in ("closed", "failed"):
                workers.pop(name, None)
        self._cluster.scale(**{"jobs" if self.engine.kind in QUEUES else "n": self.engine.workers})


class _Complaints(logging.Handler):
    """Keeps the last error of what runs beside, in one line."""

    text = ""

    def emit(self, record):
        if record.exc_info and record.exc_info[1]:
            said = str(record.exc_info[1])
            self.text = " ".join((said.rpartition("stderr:")[2].strip() or said).split())


def _first(error):
    """:returns: the error that an error came from"""
    while error.__cause__ or error.__context__:
        error = error.__cause__ or error.__context__
    return error


def environment():
    """:returns: dict of what a worker's Python needs to find this Patina, and to show Dask's pages to nobody"""
    module = sys.modules.get("_patina")
    paths = [os.path.dirname(os.path.dirname(os.path.abspath(patina.__file__)))]
    if module:
        paths.append(os.path.dirname(os.path.abspath(module.__file__)))
    kept = {name: os.environ[name] for name in ("PATINA_BUILD_DIR", "PATINA_CACHE", "PATINA_OIDN_LIBRARY",
                                                *identity.ENVIRONMENT)
            if os.environ.get(name)}
    return {"PYTHONPATH": os.pathsep.join(dict.fromkeys(paths)), "PYTHONSAFEPATH": "1",
            "DASK_DISTRIBUTED__WORKER__HTTP__ROUTES": "[]", **kept}


def _configure(page):
    """Dask would write of every worker that comes and goes, over the line of progress; workers, too.

    :param page: whether its scheduler answers questions of anybody"""
    with contextlib.suppress(ImportError):
        import dask

        quiet = {name: "critical" for name in ("distributed", "distributed.client", "distributed.nanny")}
        dask.config.set({"logging": quiet, "distributed.nanny.pre-spawn-environ.DASK_LOGGING__DISTRIBUTED": "critical",
                         # A client asks by itself for a list without workers: read in place of ours, all seem to have gone.
                         "distributed.client.scheduler-info-interval": "1000 days"})
        if not page:
            dask.config.set({"distributed.worker.http.routes": [], "distributed.scheduler.http.routes": []})


@contextlib.contextmanager
def _own_folder():
    """Yields where Dask keeps files of this process within the block: its own choice is one place for all users, where others
    can write the scripts of jobs between their naming and their making."""
    import dask

    before = tempfile.tempdir
    with certificates.private_folder(tempfile.gettempdir(), "~") as folder, dask.config.set({"temporary-directory": folder}):
        tempfile.tempdir = folder
        try:
            yield folder
        finally:
            tempfile.tempdir = before


@contextlib.contextmanager
def _loop():
    """Yields the loop of a thread that hears no signals, nor do the workers that it starts: a Ctrl+C at a terminal comes to
    all of them, and this process ends them. Dask's own thread has ten seconds to start, which a busy machine may not give."""
    from tornado.ioloop import IOLoop

    started = concurrent.futures.Future()

    async def serve():
        stop = asyncio.Event()
        started.set_result((IOLoop.current(), stop))
        await stop.wait()

    def run():
        try:
            asyncio.run(serve())
        except BaseException as error:
            if started.done():
                raise
            started.set_exception(error)

    thread = threading.Thread(target=run, name="loop of the farm's engine", daemon=True)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, interrupts.NUMBERS)
    try:
        resource_tracker.ensure_running()  # else the thread starts it, and hears signals after that
        signal.pthread_sigmask(signal.SIG_BLOCK, interrupts.NUMBERS)
        thread.start()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    loop, stop = started.result()
    try:
        yield loop
    finally:
        loop.add_callback(stop.set)
        thread.join(10)


def _import(name, package):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise CommandError(f"this engine needs {package} (pip install {package}): {error}") from error
