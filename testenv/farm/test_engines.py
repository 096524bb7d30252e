# SPDX-License-Identifier: Apache-2.0
"""Engines: what they are written as, and movies on real ones."""
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import time
import types
import urllib.error
import urllib.request

import pytest

import movie
from inProcess import patina
from patina.cli.errors import CommandError, TemporaryError, UsageError
from patina.farm import certificates, engines, folders

FLAGS = ["--imageWidth=48", "--samples=16"]


def test_engines_are_written_as_addresses_and_numbers():
    assert engines.parse("dask://farm", []) == engines.Engine("dask", "tcp://farm:8786", 0, {})
    assert engines.parse("dask://10.0.0.1:99", []).address == "tcp://10.0.0.1:99"
    assert engines.parse("local:3", []).workers == 3
    assert engines.parse("slurm:8", ["cores=4", "queue=render"]).options == {"cores": 4, "queue": "render"}
    for text in ("slurm", "local:0", "dask://", "dask://a b", "carrier", "k8s"):
        with pytest.raises(UsageError):
            engines.parse(text, [])
    with pytest.raises(UsageError):
        engines.parse("local:1", ["cores"])


def farm(folder, stage, *arguments):
    """Runs `patina farm` in a process of its own. :returns: the finished process"""
    return subprocess.run(movie.command("farm", stage, os.path.join(str(folder), "movie.####.exr"), *arguments),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300)


@pytest.fixture(scope="module")
def shot(tmp_path_factory):
    pytest.importorskip("distributed")
    folder = tmp_path_factory.mktemp("farm")
    stage = movie.write_stage(folder)
    names = movie.at_once(stage, str(folder / "once"), "1:2", FLAGS)
    return folder, stage, names


def test_a_cut_movie_has_the_bits_of_one_process(shot):
    folder, stage, names = shot
    (folder / "cut").mkdir()
    result = farm(folder / "cut", stage, "--frames=1:2", "--cut=1x2", "--engine=local:2", *FLAGS)
    assert result.returncode == 0, result.stderr
    assert not movie.different(names, folder / "once", folder / "cut")
    assert sorted(os.listdir(folder / "cut")) == names, "parts and logs are gone when images are there"
    table = result.stdout.splitlines()
    assert table[0].split() == ["worker", "host", "tasks", "seconds", "a", "task", "busy", "failed", "lost"]
    assert re.match(r"all +6 .* 0 +0 +in ", table[-1]), "2 frames of 2 parts and a merge"
    # Goes on: one image is missing, and a part of it is there; the other part is of another seed.
    before = {name: os.stat(folder / "cut" / name).st_mtime_ns for name in names}
    os.remove(folder / "cut" / names[1])
    parts = folder / "cut" / (names[1] + ".parts")
    for number, seed in ((1, 0), (2, 1)):
        patina("record", stage, folder / "cut" / "movie.####.exr", "--frames=2", *FLAGS, f"--seed={seed}",
               f"--part={number}/1x2", f"--partial={parts}/{number}.part", "--quiet")
    result = farm(folder / "cut", stage, "--frames=1:2", "--cut=1x2", "--engine=local:1", "--resume", *FLAGS)
    assert result.returncode == 0, result.stderr
    assert re.search(r"^all +2 ", result.stdout, re.MULTILINE), "part 2 and a merge"
    assert not movie.different(names, folder / "once", folder / "cut")
    after = {name: os.stat(folder / "cut" / name).st_mtime_ns for name in names}
    assert [name for name in names if before[name] != after[name]] == [names[1]]


def test_what_fails_is_tried_on_others_and_told(shot):
    folder, stage, _ = shot
    (folder / "failing").mkdir()
    result = farm(folder / "failing", stage, "--frames=1", "--engine=local:2", *FLAGS, "--camera=/none")
    assert result.returncode == 1
    assert "1 of 1 images are not written" in result.stderr and "/none" in result.stderr
    assert len(result.stdout.splitlines()) == 4, "a head, two workers that it failed on, and their sum"
    assert re.search(r"^all +0 .* 4 +0 +in ", result.stdout, re.MULTILINE)
    logs = [os.path.join(root, name) for root, _, names in os.walk(folder / "failing") for name in names]
    assert len(logs) == 4 and all("/none" in open(log, encoding="utf-8").read() for log in logs)


def test_workers_are_refused_that_cannot_read_or_compute_otherwise(tmp_path):
    import _patina

    from patina.farm import identity, worker

    machine = identity.of_machine(_patina)
    assert worker.check("a", [movie.__file__], [str(tmp_path)], machine) == []
    problems = worker.check("b", ["/no/such/file"], ["/no/such/folder"], dict(machine, **{"instruction set": "abacus"}))
    assert problems[:2] == ["cannot read /no/such/file", "cannot write to /no/such/folder"]
    assert problems[2].startswith("instruction set is ") and problems[2].endswith("not abacus")
    with pytest.raises(worker.Refused, match="cannot read /no/such/file, and 1 more"):
        worker.run(["--version"], str(tmp_path), str(tmp_path / "log"), ("b", [], [], {}))


def test_the_words_of_a_queue_that_refuses_are_told(tmp_path):
    pytest.importorskip("dask_jobqueue")
    (tmp_path / "sbatch").write_text("#!/bin/sh\necho 'sbatch: error: invalid partition: nope' >&2\nexit 1\n")
    (tmp_path / "sbatch").chmod(0o755)
    stage = movie.write_stage(tmp_path)
    result = subprocess.run(
        movie.command("farm", stage, tmp_path / "a.exr", "--engine=slurm:2", "--engineOption=walltime=00:10:00", "--quiet"),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120,
        env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"})
    assert result.returncode == 1
    assert result.stderr == "patina: no workers of slurm:2: sbatch: error: invalid partition: nope\n"
    assert not (tmp_path / "a.exr.parts").exists()


def nobody_else_comes_in(cluster):
    """Another user of this machine finds the ports, and has no key, or one of his own. Pages that need none show nothing."""
    import distributed

    found = cluster.client.scheduler_info(n_workers=-1)["workers"]
    addresses = [cluster._cluster.scheduler_address, *found, *(one["nanny"] for one in found.values())]
    own = distributed.Security.temporary()
    for address in addresses:
        place = address.partition("://")[2]
        assert address == f"tls://{place}"
        for other, security in ((f"tcp://{place}", None), (f"tls://{place}", own)):
            with pytest.raises(OSError):
                distributed.Client(other, security=security, timeout="5s")
    pages = [cluster._cluster.scheduler.http_server.port, *(one["services"]["dashboard"] for one in found.values())]
    for port in pages:
        for name in ("", "status", "info/main/workers.html", "metrics"):
            with pytest.raises(urllib.error.HTTPError, match="404"):
                urllib.request.urlopen(f"http://127.0.0.1:{port}/{name}", timeout=10)
    assert cluster.dashboard() == ""
    for one in found.values():
        folder = os.path.dirname(os.path.dirname(one["local_directory"]))
        assert stat.S_IMODE(os.stat(folder).st_mode) == 0o700


@pytest.mark.parametrize("page", ["", "127.0.0.1:1"])
@pytest.mark.parametrize("engine, name", [("local:1", "scheduler_kwargs"), ("slurm:1", "scheduler_options")])
def test_options_of_the_scheduler_open_no_page_of_dasks(engine, name, page, monkeypatch):
    """It has an option of its own."""
    given = {"port": 9, "dashboard": True, "dashboard_address": ":8787"}
    options = [f"{name}={json.dumps(given)}"] + ([f"dashboard_address={page}"] if page else [])
    monkeypatch.setitem(sys.modules, "dask_jobqueue", types.SimpleNamespace(SLURMCluster=dict))
    utils = pytest.importorskip("distributed").utils
    dask = types.SimpleNamespace(LocalCluster=dict, Security=types.SimpleNamespace(temporary=str), utils=utils)
    cluster = engines.Cluster(engines.parse(engine, options), tempfile.gettempdir())
    try:
        made = cluster._start(dask)
    finally:
        cluster.__exit__()
    assert made[name] == {"port": 9, "dashboard": bool(page), "dashboard_address": page or "127.0.0.1:0"}
    assert not {"dashboard", "dashboard_address"} & set(made)


def planted(folder):
    """Leads the files at the place that Dask chooses for all users of a machine to another one. :returns: that"""
    place, mine = folder / "dask-scratch-space", folder / "mine"
    place.mkdir()
    mine.write_text("mine")
    for name in ("global.lock", "purge.lock"):
        os.symlink(mine, place / name)
    return mine


def test_files_of_dask_lie_where_nobody_else_puts_links(tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    mine = planted(tmp_path)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with engines.Cluster(engines.parse("local:1", []), str(tmp_path)) as cluster:
        cluster.client.wait_for_workers(1, timeout=60)
    assert mine.read_text() == "mine" and sorted(os.listdir(tmp_path)) == ["dask-scratch-space", "mine"]


def test_a_job_of_a_queue_has_a_folder_of_its_own(tmp_path):
    lines = engines.queue_options({"job_script_prologue": ["echo more"]})["job_script_prologue"]
    script = "\n".join([*lines, 'stat -c %a "$DASK_TEMPORARY_DIRECTORY"', 'dirname "$DASK_TEMPORARY_DIRECTORY"'])
    done = subprocess.run(["bash", "-c", script], env={**os.environ, "TMPDIR": str(tmp_path)}, capture_output=True, text=True)
    assert done.stdout.split() == ["more", "700", str(tmp_path)], done.stderr
    assert os.listdir(tmp_path) == []


# As before version 3.11, which is the first to know PYTHONSAFEPATH.
OLDER_PYTHON = f"""#!/bin/sh
exec env -u PYTHONSAFEPATH "{sys.executable}" "$@"
"""
HOSTILE = "import os\nopen(os.environ['RAN'], 'w').close()\n"


def test_a_job_of_a_queue_runs_nothing_of_the_folder_that_sent_it(tmp_path):
    """`python -m` looks there first."""
    (tmp_path / "platform.py").write_text(HOSTILE)
    (tmp_path / "older").write_text(OLDER_PYTHON)
    (tmp_path / "older").chmod(0o755)
    lines = engines.queue_options({"job_script_prologue": ["[ -f platform.py ] && echo there"]})["job_script_prologue"]
    for script, ran in (([*lines, "cd - >/dev/null"], True), (lines, False)):
        done = subprocess.run(["bash", "-c", "\n".join([*script, f"{tmp_path}/older -m platform"])], cwd=tmp_path,
                              env={**os.environ, "RAN": str(tmp_path / "ran")}, capture_output=True, text=True)
        assert done.stdout.startswith("there\n") and (tmp_path / "ran").exists() is ran, done.stderr
        (tmp_path / "ran").unlink(missing_ok=True)


@pytest.mark.skipif(sys.version_info < (3, 11), reason="PYTHONSAFEPATH is of 3.11")
def test_workers_of_an_installed_patina_run_nothing_of_the_current_folder(tmp_path):
    pytest.importorskip("distributed")
    command, evil = tmp_path / "bin" / "patina", tmp_path / "evil"
    for folder in (command.parent, evil / "multiprocessing"):
        folder.mkdir(parents=True)
    (evil / "multiprocessing" / "__init__.py").write_text(HOSTILE)
    command.write_text("import sys\nfrom patina.cli.entry import run\nif __name__ == '__main__':\n    sys.exit(run())\n")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    result = subprocess.run([sys.executable, str(command), "farm", movie.write_stage(tmp_path), str(tmp_path / "a.exr"),
                             "--engine=local:1", *FLAGS], cwd=evil, env={**environment, "RAN": str(tmp_path / "ran")},
                            capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr
    assert (tmp_path / "a.exr").exists() and not (tmp_path / "ran").exists()


@pytest.mark.parametrize("entries", ["{cwd}:{own}", ":{own}", "{own}:", "../evil:{own}"])
def test_an_installed_patina_runs_nothing_of_the_current_folder(tmp_path, entries):
    command, evil = tmp_path / "bin" / "patina", tmp_path / "evil"
    for folder in (command.parent, evil):
        folder.mkdir()
    (evil / "contextlib.py").write_text("import os\nopen(os.environ['RAN'], 'w')\nraise SystemExit(3)\n")
    command.write_text("import sys\nfrom patina.cli.entry import run\nif __name__ == '__main__':\n    sys.exit(run())\n")
    meant = entries.startswith("{cwd}")  # by its whole name
    path = entries.format(own=os.environ["PYTHONPATH"], cwd=evil)
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    result = subprocess.run([sys.executable, str(command), "--version"], cwd=evil, capture_output=True, text=True, timeout=60,
                            env={**environment, "PYTHONPATH": path, "RAN": str(tmp_path / "ran")})
    assert (tmp_path / "ran").exists() is meant and result.returncode == (3 if meant else 0), result.stderr


def test_a_signal_while_workers_start_is_told_in_one_line(tmp_path):
    """As Ctrl+C does at a terminal, it comes to all processes: to workers while they import."""
    pytest.importorskip("distributed")
    program = f"""
import os, signal, sys
from distributed.nanny import WorkerProcess
from patina.cli import ending, main
wait = WorkerProcess._wait_until_connected
def signalled(*arguments):
    os.killpg(0, signal.SIGINT)
    WorkerProcess._wait_until_connected = wait
    return wait(*arguments)
WorkerProcess._wait_until_connected = signalled
sys.exit(ending.end(main.main(["farm", {movie.write_stage(tmp_path)!r}, "a.exr", "--engine=local:2", "--quiet"])))
"""
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, start_new_session=True, capture_output=True, text=True,
                          timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (75, "", "patina: interrupted\n")


def test_certificates_are_files_that_are_there(tmp_path):
    (tmp_path / "key").write_text("")
    every = [f"{name}={tmp_path}/key" for name in certificates.FILES]
    assert engines.parse("dask://farm", every).address == engines.parse("tls://farm", every).address == "tls://farm:8786"
    for engine, options, words in (("dask://farm", every[:2], "tls_client_key=FILE too"),
                                   ("dask://farm", [*every, f"tls_ca_file={tmp_path}/none"], "there is no such file"),
                                   ("tcp://farm", every, "with certificates write tls:// or dask://")):
        with pytest.raises(UsageError, match=words):
            engines.parse(engine, options)


def test_which_certificates_are_missing_is_told():
    pytest.importorskip("distributed")
    with pytest.raises(CommandError, match="tls://127.0.0.1:9: name certificates: --engineOption tls_ca_file=FILE"):
        engines.Cluster(engines.parse("tls://127.0.0.1:9", []), "").__enter__()


def test_keys_lie_in_a_folder_of_the_user_alone(tmp_path, monkeypatch):
    with certificates.private_folder(str(tmp_path)) as folder:
        assert stat.S_IMODE(os.stat(folder).st_mode) == 0o700
        made = os.stat(tmp_path)
    assert os.listdir(tmp_path) == []
    monkeypatch.setattr(certificates.os, "stat", lambda _: made)  # as of a file system without permissions
    os.chmod(tmp_path, 0o755)
    made = os.lstat(tmp_path)
    with pytest.raises(CommandError, match="keeps nothing private"), certificates.private_folder(str(tmp_path)):
        pass


def test_folders_that_others_may_rename_hold_no_keys(tmp_path, monkeypatch):
    images, home = tmp_path / "images", tmp_path / "home"
    for folder, mode in ((images, 0o775), (home, 0o755)):
        (folder / "shot").mkdir(parents=True)
        os.chmod(folder, mode)
    places = str(images / "shot"), str(home)
    with certificates.private_folder(*places) as folder:
        assert os.path.dirname(folder) == str(home)
    with pytest.raises(CommandError, match=f"others may rename what is in {images}; name another by TMPDIR"):
        with certificates.private_folder(places[0]):
            pass
    with certificates.private_folder(places[0], checked=False) as folder:
        assert os.path.dirname(folder) == places[0], "the user has named it"
    with monkeypatch.context() as patch:
        patch.setattr(folders.os, "stat", lambda _: types.SimpleNamespace(st_uid=65534, st_mode=stat.S_IFDIR | 0o755))
        assert " belongs to " in folders.open_to_others(str(home))
        patch.setattr(folders, "_unknown_root", lambda: 65534)
        assert not folders.open_to_others(str(home)), "root's, in a sandbox that does not know root"
    os.chmod(images, 0o1777)
    with certificates.private_folder(*places) as folder:
        assert os.path.dirname(folder) == places[0], "the owner alone renames what is in a sticky folder"


def test_scripts_of_jobs_lie_in_a_folder_of_the_user_alone():
    pytest.importorskip("distributed")
    from dask.utils import tmpfile

    before = tempfile.tempdir
    with engines._own_folder() as folder:
        with tmpfile() as script:
            assert os.path.dirname(script) == folder
        assert stat.S_IMODE(os.stat(folder).st_mode) == 0o700
    assert tempfile.tempdir == before


@pytest.mark.parametrize("error, status", [(RuntimeError("Nanny failed to start worker process"), TemporaryError),
                                           (TypeError("no such option"), CommandError)])
def test_a_worker_that_dies_while_it_starts_may_start_the_next_time(error, status, monkeypatch):
    pytest.importorskip("distributed")

    def start(*_):
        try:
            raise error
        except (RuntimeError, TypeError) as first:
            raise RuntimeError("Nanny failed to start.") from first

    monkeypatch.setattr(engines.Cluster, "_start", start)
    with pytest.raises(CommandError, match=f"no workers of local: {error}") as told:
        engines.Cluster(engines.parse("local:1", []), "").__enter__()
    assert type(told.value) is status


def test_the_thread_of_an_engine_that_cannot_start_says_why(monkeypatch):
    pytest.importorskip("distributed")

    def run(served):
        served.close()
        raise OSError("no descriptors left")

    monkeypatch.setattr(engines.asyncio, "run", run)
    with pytest.raises(CommandError, match="no workers of local: no descriptors left"):
        engines.Cluster(engines.parse("local:1", []), "").__enter__()


@pytest.mark.parametrize("forgotten", (False, True), ids=("known", "forgotten"))
def test_workers_that_do_not_come_back_are_replaced(tmp_path, monkeypatch, forgotten):
    """A worker whose keeper is closed, too, is started by nobody else."""
    pytest.importorskip("distributed")
    with engines.Cluster(engines.parse("local:2", []), str(tmp_path)) as cluster:
        cluster.client.wait_for_workers(2, timeout=60)
        local = cluster._cluster
        if forgotten:
            nobody_else_comes_in(cluster)
        before = set(cluster.client.scheduler_info(n_workers=-1)["workers"])
        time.sleep(2.5)
        assert set(cluster.client._scheduler_identity["workers"]) == before, "Dask asks every two seconds for a list of none"
        for name, nanny in list(local.workers.items()):
            local.sync(nanny.close)
            if forgotten:  # as Dask does after its setting distributed.deploy.lost-worker-timeout
                local.workers.pop(name)
        end = time.monotonic() + 60
        while cluster.client.scheduler_info(n_workers=-1)["workers"] and time.monotonic() < end:
            time.sleep(0.05)
        cluster.replace(2)
        assert not cluster.client.scheduler_info(n_workers=-1)["workers"], "nobody is missed"
        monkeypatch.setattr(engines, "REPLACE_SECONDS", 0.0)
        cluster.replace(0)
        cluster.client.wait_for_workers(2, timeout=60)
        assert not before & set(cluster.client.scheduler_info(n_workers=-1)["workers"])


def test_a_movie_survives_the_death_of_its_workers(tmp_path):
    pytest.importorskip("distributed")
    import killedMovie

    status, killed, wrong, names = killedMovie.run(str(tmp_path), "1:12", "2x2", 4, 2.0, ["--imageWidth=160", "--samples=64"])
    assert killed >= 3, "the movie was done before it showed anything"
    assert status == 0 and len(names) == 12 and not wrong


def test_a_movie_through_slurm(tmp_path):
    pytest.importorskip("dask_jobqueue")
    import slurmMovie

    process, wrong, names = slurmMovie.run(str(tmp_path), "1:3", "2", 2, FLAGS)
    if process.returncode == slurmMovie.MISSING:
        pytest.skip(process.stdout.strip())
    assert process.returncode == 0, process.stdout
    assert len(names) == 3 and not wrong
    assert shutil.which("sbatch")
