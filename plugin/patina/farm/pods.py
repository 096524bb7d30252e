# SPDX-License-Identifier: Apache-2.0
"""Pods of Kubernetes as workers of a scheduler in this process. A Secret has the run's key for them, and goes with the run."""
import asyncio
import contextlib
import copy
import json
import re
import uuid

from patina.cli.errors import UsageError

COMMAND = ["dask-worker", "--nthreads", "1"]  # one part at a time, which takes all of a pod's cores
KEYS = "/run/patina-farm"  # where a pod finds the key
ALONE_SECONDS = 60  # after which a pod ends that finds no scheduler
_OPTIONS = ("image", "volumes", "namespace", "name", "resources", "env", "worker_command", "custom_cluster_spec", "interface",
            "dashboard_address", "scheduler_options")
_NAMESPACE = "/var/run/secrets/kubernetes.io/serviceaccount/namespace"  # of this process, where it is in a pod itself
_VOLUME = re.compile(r"([a-z0-9](?:[a-z0-9.-]*[a-z0-9])?):(/[^:,]*)")  # a claim's name by Kubernetes' rules, and a path


def check(options):
    """:param options: those of --engineOption
    :raises UsageError: where no pod could render with them"""
    for name in options:
        if name not in _OPTIONS:
            raise UsageError(f"patina farm: --engineOption {name}: k8s knows {', '.join(_OPTIONS)}")
    for name in ("env", "resources"):
        if not isinstance(options.get(name, {}), dict):
            raise UsageError(f'patina farm: --engineOption {name}: write it as {{"NAME": "VALUE"}}')
    if "custom_cluster_spec" in options:
        _template(options)
    elif "image" not in options:
        raise UsageError("patina farm: k8s wants --engineOption image=NAME: a container image with this Patina and distributed")
    _volumes(options.get("volumes", ""))


def start(distributed, kubernetes, options, variables, page, shared, stack):
    """:param variables: dict of what a worker's Python needs
    :param page: options of the scheduler
    :param shared: options of the cluster, among them distributed.Security of the run
    :param stack: ExitStack at whose end the key is taken back
    :returns: a cluster without workers
    :raises RuntimeError: where Kubernetes refuses the key"""
    from distributed.deploy.spec import ProcessInterface

    _asked(kubernetes.config.load_config)
    api, namespace = kubernetes.client.CoreV1Api(), options.get("namespace") or _asked(_namespace, kubernetes.config)
    security, own = shared["security"], options.get("name") or "patina-" + uuid.uuid4().hex[:8]
    _asked(api.create_namespaced_secret, namespace, secret(own, security))
    stack.callback(_gone, api.delete_namespaced_secret, own, namespace)
    made = pod(own, options, variables)

    class Pod(ProcessInterface):
        """A worker, which Kubernetes gives a name."""
        job_id = None

        def __init__(self, scheduler, name):
            super().__init__()
            self._body = copy.deepcopy(made)
            self._body["spec"]["containers"][0]["args"] += [scheduler, "--name", name]

        async def start(self):
            try:
                created = await asyncio.to_thread(_asked, api.create_namespaced_pod, namespace, self._body)
            except RuntimeError:
                self.status = distributed.Status.failed
                raise
            self.job_id = created.metadata.name
            await super().start()

        async def close(self):
            if self.job_id:
                await asyncio.to_thread(_gone, api.delete_namespaced_pod, self.job_id, namespace)
            await super().close()

    class Pods(distributed.SpecCluster):
        def _new_worker_name(self, number):
            return f"{own}-{number}"

    scheduler = {"protocol": "tls://", "security": security, "interface": options.get("interface"), **page}
    return Pods(scheduler={"cls": distributed.Scheduler, "options": scheduler}, worker={"cls": Pod}, name=own, **shared)


def secret(name, security):
    """:returns: the key of the run, as Kubernetes takes it"""
    key = security.get_tls_config_for_role("worker")
    return {"metadata": {"name": name, "labels": {"patina-farm": name}},
            "stringData": {f"{file}.pem": key[file] for file in ("ca_file", "cert", "key")}}


def pod(name, options, variables):
    """:param name: of the run, and of its key
    :returns: a worker, as Kubernetes takes it, but for the scheduler's address and a name"""
    spec = _template(options) if "custom_cluster_spec" in options else {"containers": [{"image": options["image"]}]}
    container = spec["containers"][0]
    command = options.get("worker_command", COMMAND)
    container.update(name="worker", args=[
        *(command.split() if isinstance(command, str) else command), "--no-dashboard", "--death-timeout", str(ALONE_SECONDS),
        "--tls-ca-file", f"{KEYS}/ca_file.pem", "--tls-cert", f"{KEYS}/cert.pem", "--tls-key", f"{KEYS}/key.pem"])
    container.pop("command", None)
    if "resources" in options:
        container["resources"] = options["resources"]
    env = {**variables, **options.get("env", {})}
    container["env"] = container.get("env", []) + [{"name": key, "value": str(value)} for key, value in env.items()]
    volumes = _volumes(options.get("volumes", ""))
    names = {claim: f"volume{number}" for number, claim in enumerate(dict.fromkeys(claim for claim, _ in volumes))}
    spec["volumes"] = spec.get("volumes", []) + [{"name": "patina-key", "secret": {"secretName": name}}] + [
        {"name": volume, "persistentVolumeClaim": {"claimName": claim}} for claim, volume in names.items()]
    container["volumeMounts"] = container.get("volumeMounts", []) + [
        {"name": "patina-key", "mountPath": KEYS, "readOnly": True}] + [
        {"name": names[claim], "mountPath": path} for claim, path in volumes]
    spec["restartPolicy"] = "Never"  # the farm asks for another
    # A render asks nothing of Kubernetes, and needs no right of the system.
    spec.setdefault("automountServiceAccountToken", False)
    container.setdefault("securityContext", {"allowPrivilegeEscalation": False, "capabilities": {"drop": ["ALL"]}})
    return {"metadata": {"generateName": f"{name}-", "labels": {"patina-farm": name}}, "spec": spec}


def _template(options):
    """:returns: the spec of the workers' pods in a manifest of the user's
    :raises UsageError: where there is none"""
    file = options["custom_cluster_spec"]
    try:
        import yaml

        with open(file, encoding="utf-8") as stream:
            spec = yaml.safe_load(stream)["spec"]["worker"]["spec"]
        spec["containers"][0].get("env", []) + spec.get("volumes", [])
        return spec
    except Exception as error:  # of YAML, and whatever shape it has
        why = error.strerror if isinstance(error, OSError) else "it has no spec.worker.spec.containers"
        raise UsageError(f"patina farm: --engineOption custom_cluster_spec={file}: {why}") from error


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


def _namespace(config):
    with contextlib.suppress(OSError), open(_NAMESPACE, encoding="utf-8") as file:
        return file.read().strip()
    return config.list_kube_config_contexts()[1]["context"].get("namespace", "default")


def _asked(call, *arguments):
    """:raises RuntimeError: with what Kubernetes says, or why it says nothing"""
    try:
        return call(*arguments)
    except Exception as error:  # of kubernetes, and of urllib3 below it
        said = str(error)
        with contextlib.suppress(AttributeError, KeyError, TypeError, ValueError):
            said = json.loads(error.body)["message"]
    raise RuntimeError(said)


def _gone(call, *arguments):
    with contextlib.suppress(RuntimeError):  # what has gone already
        _asked(call, *arguments)
