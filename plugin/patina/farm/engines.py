# SPDX-License-Identifier: Apache-2.0
"""Engines that run the parts: a Dask cluster that is there, one of this machine, or one that a queue or Kubernetes starts."""
import contextlib
import importlib.util
import json
import logging
import os
import re
import shlex
import sys
import time
from dataclasses import dataclass, field

from patina.cli.errors import CommandError, UsageError
from patina.farm import identity, pods

QUEUES = {"slurm": "SLURMCluster", "pbs": "PBSCluster", "lsf": "LSFCluster", "sge": "SGECluster"}
HELP = ("dask://HOST[:PORT] is a scheduler that runs; local:N starts N workers here; slurm:N, pbs:N, lsf:N and sge:N ask a "
        "queue for N jobs; k8s:N asks Kubernetes for N pods (default: local, with two cores or more for each worker)")
PORT = 8786  # Dask's own
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
        return Engine("dask", f"{'tls' if scheme == 'tls' else 'tcp'}://{address}", 0, known)
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


def queue_options(engine):
    """:returns: dict of what dask-jobqueue's class for the queue takes"""
    return {"cores": 1, "processes": 1, "memory": "4GiB", "python": shlex.quote(sys.executable),
            "job_script_prologue": [f"export {name}={shlex.quote(value)}" for name, value in environment().items()],
            # One part at a time, which takes all of a job's cores.
            "worker_extra_args": ["--nthreads", "1"], **engine.options}


class Cluster:
    """The workers of an engine, while the block lasts."""

    def __init__(self, engine):
        self.engine = engine
        self._cluster = self.client = None
        self._complaints = _Complaints()
        self._asked = float("-inf")  # when for workers

    def __enter__(self):
        _quiet()
        distributed = _import("distributed", "distributed")
        try:
            if self.engine.kind == "dask":
                self.client = distributed.Client(self.engine.address, timeout="30s", **self.engine.options)
            else:
                self._cluster = self._start(distributed)
                self._scale()
                self.client = distributed.Client(self._cluster)
        except (OSError, RuntimeError, ValueError, TypeError) as error:
            self.__exit__()
            place = self.engine.address or self.engine.kind
            raise CommandError(f"no workers of {place}: {' '.join(str(error).split()) or type(error).__name__}") from error
        return self

    def __exit__(self, *_):
        for one in (self.client, self._cluster):
            if one is not None:
                # A scheduler that died does not answer, and jobs that were refused are no running ones.
                with contextlib.suppress(OSError, RuntimeError, TimeoutError, AssertionError):
                    one.close()

    def problem(self):
        """:returns: why no worker will come, where the queue has taken no job; else an empty text"""
        jobs = list(getattr(self._cluster, "workers", {}).values())
        return "" if any(getattr(job, "job_id", None) for job in jobs) else self._complaints.text

    def replace(self, there):
        """Asks for workers in the place of those that went away: Dask forgets a worker that is away for longer than its setting
        `distributed.deploy.lost-worker-timeout`, and starts no other by itself. An operator of Kubernetes does so.

        :param there: how many workers there are"""
        if self._cluster is None or self.engine.kind == "k8s" or there >= self.engine.workers:
            return
        if time.monotonic() - self._asked >= REPLACE_SECONDS:
            self._scale()

    def dashboard(self):
        """:returns: the address of Dask's own page, or an empty text: it needs bokeh"""
        if self.engine.kind != "dask" and not importlib.util.find_spec("bokeh"):
            return ""
        return getattr(self.client, "dashboard_link", "") or ""

    def _start(self, distributed):
        engine = self.engine
        if engine.kind == "local":
            return distributed.LocalCluster(**{"n_workers": engine.workers, "threads_per_worker": 1, "processes": True,
                                               "memory_limit": 0, "dashboard_address": "127.0.0.1:0", **engine.options})
        if engine.kind == "k8s":
            operator = _import("dask_kubernetes.operator", "dask-kubernetes")
            return operator.KubeCluster(**pods.cluster_options(operator.make_cluster_spec, engine.workers, engine.options,
                                                               environment()))
        jobqueue = _import("dask_jobqueue", "dask-jobqueue")
        # A queue's reason to refuse a job is told nowhere else.
        for name in ("tornado.application", "asyncio"):
            log = logging.getLogger(name)
            log.handlers, log.propagate = [self._complaints], False
        return getattr(jobqueue, QUEUES[engine.kind])(**queue_options(engine))

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


def environment():
    """:returns: dict of what a worker's Python needs to find this Patina"""
    import patina

    module = sys.modules.get("_patina")
    paths = [os.path.dirname(os.path.dirname(os.path.abspath(patina.__file__)))]
    if module:
        paths.append(os.path.dirname(os.path.abspath(module.__file__)))
    kept = {name: os.environ[name] for name in ("PATINA_BUILD_DIR", "PATINA_CACHE", "PATINA_OIDN_LIBRARY",
                                                *identity.ENVIRONMENT)
            if os.environ.get(name)}
    return {"PYTHONPATH": os.pathsep.join(dict.fromkeys(paths)), "PYTHONSAFEPATH": "1", **kept}


def _quiet():
    """Dask would write of every worker that comes and goes, over the line of progress."""
    with contextlib.suppress(ImportError):
        import dask

        dask.config.set({"logging": {name: "critical" for name in ("distributed", "distributed.client", "distributed.nanny")}})


def _import(name, package):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise CommandError(f"this engine needs {package} (pip install {package}): {error}") from error
