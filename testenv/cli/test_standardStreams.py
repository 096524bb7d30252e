# SPDX-License-Identifier: Apache-2.0
"""Standard streams that are closed, cut or full: what cannot be written is lost, and the image is written."""
import io
import os
import subprocess
import sys

import pytest

import _patina
from patina.cli import standardStreams
from usda import prim

# Enough warnings for a pipe that nobody reads.
STAGE = "#usda 1.0\n" + "".join((
    prim("Material", f"m{i}", f"token outputs:surface.connect = </nothing{i}.outputs:surface>")
    + prim("Sphere", f"ball{i}", f"rel material:binding = </m{i}>")) for i in range(30))


@pytest.fixture
def stage(tmp_path):
    (tmp_path / "stage.usda").write_text(STAGE)
    return tmp_path


@pytest.mark.parametrize("streams, status", [
    ("2>&1 | head -c 10", None), ("2>&-", 0), ("<&- >&- 2>&-", 0), ("2>/dev/full", 0), ("--json 2>&1 | head -c 10", None),
    ("--json >/dev/full", 75),
])
def test_the_image_is_written(streams, status, stage):
    command = f"{sys.executable} -m patina record stage.usda a.png -w 8 --samples 1 {streams}"
    done = subprocess.run(["bash", "-c", command], cwd=stage, capture_output=True, text=True, timeout=120)
    assert "Traceback" not in done.stdout + done.stderr and "Exception ignored" not in done.stdout + done.stderr
    assert status is None or done.returncode == status, done.stderr
    assert _patina.read_image(str(stage / "a.png")).width == 8
    assert sorted(os.listdir(stage)) == ["a.png", "stage.usda"]


def test_descriptors_of_closed_streams_are_not_those_of_files(stage):
    """Else what libraries write to standard error would go into the first file that is opened."""
    program = ("from patina.cli import interrupts; interrupts.hold_standard_streams(); import os, stat; "
               "assert all(stat.S_ISCHR(os.fstat(i).st_mode) for i in range(3)); "
               "f = open('file', 'w'); assert f.fileno() > 2; os.write(2, b'message'); f.write('content'); f.close()")
    done = subprocess.run(["bash", "-c", f'{sys.executable} -c "{program}" <&- >&- 2>&-'], cwd=stage, timeout=60)
    assert done.returncode == 0 and (stage / "file").read_text() == "content"


class _Broken(io.StringIO):
    def write(self, text):
        raise BrokenPipeError(32, "Broken pipe")

    def flush(self):
        raise OSError(28, "No space left on device")


def test_a_stream_that_is_gone_takes_everything():
    stream = standardStreams.LosingStream(_Broken())
    assert print("text", file=stream, flush=True) is None
    stream.flush()
    assert not stream.isatty()
