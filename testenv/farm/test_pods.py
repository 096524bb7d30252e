# SPDX-License-Identifier: Apache-2.0
"""Pods of Kubernetes, without a cluster: a stand-in for its interface runs each pod's command as a process of this machine."""
import contextlib
import itertools
import json
import os
import subprocess
import sys
import tempfile
import time
import types

import pytest

from patina.cli.errors import CommandError, UsageError
from patina.farm import certificates, engines, pods
from test_engines import nobody_else_comes_in, planted

SPEC = """spec: {worker: {spec: {nodeSelector: {kind: render}, volumes: [{name: own, emptyDir: {}}], containers: [
  {name: any, image: studio/own:2, command: [sh], args: [none], env: [{name: A, value: b}]}]}}}"""


class Refusal(Exception):
    """As of Kubernetes' client: what is to be told lies in its body."""
    body = '{"message": "it is forbidden"}'

    def __str__(self):
        return "(403)\nReason: Forbidden"


class Api:
    """What the farm asks of Kubernetes."""

    def __init__(self, folder):
        self.folder, self.secrets, self.pods, self.refused = folder, {}, {}, ()
        self.numbers = itertools.count()

    def create_namespaced_secret(self, namespace, body):
        if "secret" in self.refused:
            raise Refusal
        assert body["metadata"]["labels"] == {"patina-farm": body["metadata"]["name"]}, "it is found as pods are"
        self.secrets[body["metadata"]["name"], namespace] = body["stringData"]

    def delete_namespaced_secret(self, name, namespace):
        del self.secrets[name, namespace]

    def create_namespaced_pod(self, namespace, body):
        if "pod" in self.refused:
            raise Refusal
        container = body["spec"]["containers"][0]
        keys = {volume["name"]: volume["secret"]["secretName"] for volume in body["spec"]["volumes"]}
        mount = next(mount for mount in container["volumeMounts"] if mount["mountPath"] == pods.KEYS)
        for name, text in self.secrets[keys[mount["name"]], namespace].items():
            (self.folder / name).write_text(text)
        program, *words = (word.replace(pods.KEYS, str(self.folder)) for word in container["args"])
        assert program == "dask-worker"
        env = {**os.environ, **{one["name"]: one["value"] for one in container["env"]},
               "DASK_TEMPORARY_DIRECTORY": str(self.folder)}
        name = f"{body['metadata']['generateName']}{next(self.numbers)}"
        self.pods[name, namespace] = subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_worker", *words], env=env)
        return types.SimpleNamespace(metadata=types.SimpleNamespace(name=name))

    def delete_namespaced_pod(self, name, namespace):
        process = self.pods.pop((name, namespace))
        process.kill()
        process.wait()


@pytest.fixture(name="api")
def _api(tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    tmp_path.chmod(0o700)
    api = Api(tmp_path)
    config = types.SimpleNamespace(load_config=lambda: None,
                                   list_kube_config_contexts=lambda: ([], {"context": {"namespace": "render"}}))
    monkeypatch.setitem(sys.modules, "kubernetes", types.SimpleNamespace(
        config=config, client=types.SimpleNamespace(CoreV1Api=lambda: api)))
    yield api
    for process in api.pods.values():
        process.kill()


def wait(holds):
    end = time.monotonic() + 120
    while not holds() and time.monotonic() < end:
        time.sleep(0.05)
    assert holds()


def test_pods_accept_who_has_the_key_alone_and_are_replaced(api, monkeypatch):
    import dask

    engine = engines.parse("k8s:2", ["image=a", "interface=lo", 'scheduler_options={"dashboard": true}'])
    temporary = api.folder / "temporary"
    temporary.mkdir()
    mine = planted(temporary)
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.setattr(engines, "REPLACE_SECONDS", 0.0)
    with dask.config.set({"distributed.deploy.lost-worker-timeout": 0}), engines.Cluster(engine, "") as cluster:
        cluster.client.wait_for_workers(2, timeout=120)
        assert cluster.openness() == "" and cluster.problem() == ""
        nobody_else_comes_in(cluster)
        before = list(api.pods)
        api.pods[before[0]].kill()
        wait(lambda: before[0] not in api.pods)  # what is left of it is taken away
        cluster.replace(1)
        wait(lambda: len(api.pods) == 2 and len(cluster.client.scheduler_info(n_workers=-1)["workers"]) == 2)
    assert not api.pods and not api.secrets and mine.read_text() == "mine"


@pytest.mark.parametrize("what", ["secret", "pod"])
def test_what_kubernetes_refuses_is_told_and_asked_for_again(api, monkeypatch, what):
    monkeypatch.setattr(engines, "REPLACE_SECONDS", 0.0)
    api.refused = (what,)
    engine = engines.parse("k8s:1", ["image=a", "interface=lo"])
    if what == "secret":
        with pytest.raises(CommandError, match="^no workers of k8s: it is forbidden$"):
            engines.Cluster(engine, "").__enter__()
    else:
        with engines.Cluster(engine, "") as cluster:
            wait(cluster.problem)
            assert cluster.problem() == "it is forbidden"
            api.refused = ()
            cluster.replace(0)
            wait(lambda: api.pods)
    assert not api.secrets


def test_two_jobs_have_pods_of_their_own(api):
    import distributed

    shared = {"security": certificates.of_run(distributed)}
    with contextlib.ExitStack() as stack:
        for _ in range(2):
            stack.enter_context(pods.start(distributed, sys.modules["kubernetes"], {"image": "a"}, {},
                                           {"dashboard_address": "127.0.0.1:0"}, shared, stack))
        assert len(api.secrets) == 2 and {namespace for _, namespace in api.secrets} == {"render"}
    assert not api.secrets


def test_pods_that_cannot_render_are_refused(tmp_path):
    engines.parse("k8s:2", ["image=a", "volumes=shows:/shows,my-textures:/assets/textures"])
    (tmp_path / "none.yaml").write_text("spec: {}")
    for options, words in (([], "image=NAME"), (["image=a", "volumes=/shows"], "CLAIM:/PATH"),
                           (["image=a", "volumes=A_b:/x"], "CLAIM:/PATH"),
                           (["image=a", "jupyter=true"], "jupyter: k8s knows image, "),
                           (["image=a", "env=A"], 'env: write it as {"NAME": "VALUE"}'),
                           ([f"custom_cluster_spec={tmp_path}/none.yaml"], "none.yaml: it has no spec.worker.spec.containers"),
                           ([f"custom_cluster_spec={tmp_path}/none"], "none: No such file or directory")):
        with pytest.raises(UsageError, match=words):
            engines.parse("k8s:2", options)


@pytest.fixture(name="bodies")
def _bodies(tmp_path):
    """:returns: pods of options, and of a manifest too"""
    (tmp_path / "own.yaml").write_text(SPEC)
    options = engines.parse("k8s:3", [
        "image=studio/patina:1", "volumes=shows:/shows,shows:/again,textures:/textures",
        "worker_command=dask-worker --nthreads 1",
        'resources={"limits": {"cpu": "8"}}', 'env={"OCIO": "/shows/config.ocio"}']).options
    return [pods.pod("patina-1", {**options, **more}, {"PYTHONPATH": "/shows/patina"})
            for more in ({}, {"custom_cluster_spec": str(tmp_path / "own.yaml")})]


def test_pods_hold_what_options_say(bodies):
    for body in bodies:
        pod, container = body["spec"], body["spec"]["containers"][0]
        assert container["args"][:3] == ["dask-worker", "--nthreads", "1"], "a pod takes one part at a time"
        for name, value in (("OCIO", "/shows/config.ocio"), ("PYTHONPATH", "/shows/patina")):
            assert {"name": name, "value": value} in container["env"]
        assert "command" not in container and container["name"] == "worker"
        sources = {volume["name"]: volume.get("persistentVolumeClaim", {}).get("claimName") for volume in pod["volumes"]}
        mounts = [(sources[mount["name"]], mount["mountPath"]) for mount in container["volumeMounts"]]
        assert mounts == [(None, pods.KEYS), ("shows", "/shows"), ("shows", "/again"), ("textures", "/textures")]
        assert container["resources"] == {"limits": {"cpu": "8"}} and pod["restartPolicy"] == "Never"
    images = [body["spec"]["containers"][0]["image"] for body in bodies]
    assert images == ["studio/patina:1", "studio/own:2"] and bodies[1]["spec"]["nodeSelector"] == {"kind": "render"}
    assert {"name": "A", "value": "b"} in bodies[1]["spec"]["containers"][0]["env"]


def test_pods_have_no_rights_but_those_of_a_manifest(bodies, tmp_path):
    for body in bodies:
        assert body["spec"]["automountServiceAccountToken"] is False
        assert body["spec"]["containers"][0]["securityContext"] == {
            "allowPrivilegeEscalation": False, "capabilities": {"drop": ["ALL"]}}
    own = {"capabilities": {"add": ["SYS_NICE"]}}
    spec = {"automountServiceAccountToken": True, "containers": [{"image": "a", "securityContext": own}]}
    (tmp_path / "wants.yaml").write_text(json.dumps({"spec": {"worker": {"spec": spec}}}))
    made = pods.pod("patina-1", {"custom_cluster_spec": str(tmp_path / "wants.yaml")}, {})["spec"]
    assert made["automountServiceAccountToken"] is True and made["containers"][0]["securityContext"] == own


def test_pods_are_what_kubernetes_knows(bodies):
    client = pytest.importorskip("kubernetes.client", reason="kubernetes is not installed")
    api = client.ApiClient()  # its classes take all of it: what they do not know would not come back
    for body in bodies:
        assert api.sanitize_for_serialization(api._ApiClient__deserialize(body, "V1Pod")) == body
