# SPDX-License-Identifier: Apache-2.0
"""Pods of Kubernetes as workers, started by Dask's operator (dask-kubernetes)."""
import re
import uuid

from patina.cli.errors import UsageError

NAME = "patina-" + uuid.uuid4().hex[:8]  # Dask connects to a cluster that has the name already: somebody else's
COMMAND = ["dask-worker", "--nthreads", "1"]  # one part at a time, which takes all of a pod's cores
_OF_PODS = ("image", "resources", "env", "worker_command", "scheduler_service_type", "idle_timeout", "jupyter")
_VOLUME = re.compile(r"([a-z0-9](?:[a-z0-9.-]*[a-z0-9])?):(/[^:,]*)")  # a claim's name by Kubernetes' rules, and a path


def check(options):
    """:param options: those of --engineOption
    :raises UsageError: where no pod could render with them"""
    if "custom_cluster_spec" in options:
        return
    if "image" not in options:
        raise UsageError("patina farm: k8s wants --engineOption image=NAME: a container image with this Patina and distributed")
    _volumes(options.get("volumes", ""))


def cluster_options(make_spec, workers, options, environment):
    """:param make_spec: make_cluster_spec of dask_kubernetes
    :param environment: dict of what a worker's Python needs
    :returns: dict of what KubeCluster takes"""
    if "custom_cluster_spec" in options:
        return options
    of_pods = {name: options[name] for name in _OF_PODS if name in options}
    env = of_pods.pop("env", {})
    spec = make_spec(options.get("name", NAME), n_workers=workers, env={**environment, **env},
                     **{"worker_command": list(COMMAND), **of_pods})
    pod = spec["spec"]["worker"]["spec"]
    volumes = _volumes(options.get("volumes", ""))
    if volumes:
        names = {claim: f"volume{number}" for number, claim in enumerate(dict.fromkeys(claim for claim, _ in volumes))}
        pod["volumes"] = [{"name": name, "persistentVolumeClaim": {"claimName": claim}} for claim, name in names.items()]
        pod["containers"][0]["volumeMounts"] = [{"name": names[claim], "mountPath": path} for claim, path in volumes]
    more = {name: value for name, value in options.items() if name not in (*_OF_PODS, "name", "volumes")}
    return {"custom_cluster_spec": spec, **more}


def _volumes(text):
    """:returns: list of (claim, path)
    :raises UsageError: where the text is no list of CLAIM:/PATH"""
    found = []
    for word in filter(None, str(text).split(",")):
        match = _VOLUME.fullmatch(word)
        if not match:
            raise UsageError(f"patina farm: --engineOption volumes={text}: write it as CLAIM:/PATH[,CLAIM:/PATH...]")
        found.append(match.groups())
    return found
