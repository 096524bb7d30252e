# SPDX-License-Identifier: Apache-2.0
"""Queues that are not on this machine. Their programs are stand-ins that keep the script of a job and run it: the scripts, and
what becomes of them, are real."""
import os
import re
import signal
import subprocess
import sys
import time

import pytest

import movie
from test_engines import planted

FLAGS = ["--imageWidth=48", "--samples=4"]
# Takes a script as its last argument or as its input, says a number, and runs the script in a session of its own.
SUBMIT = """#!/bin/bash
number=$$
if [ $# -gt 0 ] && [ -f "${{@: -1}}" ]; then cp "${{@: -1}}" "{jobs}/$number.sh"; else cat >"{jobs}/$number.sh"; fi
setsid bash "{jobs}/$number.sh" >"{jobs}/$number.log" 2>&1 </dev/null &
echo $! >"{jobs}/$number.pid"
echo "{said}"
"""
CANCEL = """#!/bin/bash
for number; do kill -- -"$(cat "{jobs}/${{number%%.*}}.pid")"; done
"""
QUEUES = {  # programs, what the first says, a walltime, and what the script must ask for
    "pbs": ("qsub", "qdel", "$number.host", "00:20:00",
            [r"#PBS -q render", r"#PBS -l select=1:ncpus=1:mem=\S+", r"#PBS -l walltime=00:20:00"]),
    "sge": ("qsub", "qdel", "Your job $number (dask-worker) has been submitted", "00:20:00",
            [r"#\$ -q render", r"#\$ -l h_rt=00:20:00"]),
    "lsf": ("bsub", "bkill", "Job <$number> is submitted to queue <render>.", "00:20",
            [r"#BSUB -q render", r"#BSUB -n 1", r"#BSUB -W 00:20", r"#BSUB -M \d+"]),
}


def alive(jobs):
    """:returns: ids of the jobs' processes that have not ended"""
    pids = [pid.read_text().strip() for pid in jobs.glob("*.pid")]
    return [int(pid) for pid in pids if os.path.exists(f"/proc/{pid}")]


def program(path, text):
    path.write_text(text)
    path.chmod(0o755)


@pytest.mark.parametrize("queue", QUEUES)
def test_a_movie_through_a_queue(tmp_path, queue):
    pytest.importorskip("dask_jobqueue")
    submit, cancel, said, walltime, directives = QUEUES[queue]
    tools, jobs, out = tmp_path / "tools", tmp_path / "jobs", tmp_path / "out"
    temporary = tmp_path / "temporary"
    for folder in (tools, jobs, out, temporary):
        folder.mkdir()
    mine = planted(temporary)
    program(tools / submit, SUBMIT.format(jobs=jobs, said=said))
    program(tools / cancel, CANCEL.format(jobs=jobs))
    stage = movie.write_stage(tmp_path)
    result = subprocess.run(
        movie.command("farm", stage, out / "movie.####.exr", "--frames=1:2", "--cut=2", f"--engine={queue}:2",
                      "--engineOption=queue=render", f"--engineOption=walltime={walltime}", "--engineOption=interface=lo",
                      *FLAGS),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=180,
        env={**os.environ, "TMPDIR": str(temporary), "PATH": f"{tools}:{os.environ['PATH']}",
             "DASK_JOBQUEUE__LSF__LSF_UNITS": "mb"})
    scripts = [script.read_text() for script in jobs.glob("*.sh")]
    try:
        assert result.returncode == 0, result.stderr + "".join(log.read_text()[-2000:] for log in jobs.glob("*.log"))
        names = movie.at_once(stage, str(tmp_path / "once"), "1:2", FLAGS)
        assert len(names) == 2 and not movie.different(names, tmp_path / "once", out)
        assert len(scripts) == 2 and re.search(r"^all +6 ", result.stdout, re.MULTILINE)
        for script in scripts:
            for line in directives:
                assert re.search(f"^{line}", script, re.MULTILINE), f"{line} is not in\n{script}"
            assert "--nthreads 1" in script and f"{sys.executable} -m distributed" in script
            assert re.search(r"^export PYTHONPATH=", script, re.MULTILINE)
    finally:
        end = time.monotonic() + 60.0  # a job that was told to end removes its folder first
        while (running := alive(jobs)) and time.monotonic() < end:
            time.sleep(0.05)
        for pid in running:
            os.killpg(pid, signal.SIGKILL)
    assert not running, "jobs were left in the queue"
    assert mine.read_text() == "mine" and sorted(os.listdir(temporary)) == ["dask-scratch-space", "mine"]
