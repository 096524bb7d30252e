# SPDX-License-Identifier: Apache-2.0
"""The plugin gets along with what its host has loaded: it exports no name, and a package brings its own libraries."""
import os
import shutil
import subprocess

import pytest

import hydraBuild
from patina.cli import hydraHosts, pluginPackage

# As a host with Python does it; prints the libraries that the process has not had before.
LOAD = """import sys
try:
    import bpy
    bpy.utils.expose_bundled_modules()
except (ImportError, AttributeError):
    pass
from pxr import Plug
mapped = lambda: {line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}
before = mapped()
Plug.Registry().RegisterPlugins(sys.argv[1])
assert Plug.Registry().GetPluginWithName("hdPatina").Load()
print("\\n".join(mapped() - before))"""


def test_the_plugin_exports_no_name():
    if not shutil.which("nm"):
        pytest.skip("there is no nm")
    plugin = os.path.join(hydraBuild.folder("plugin"), "hdPatina.so")
    done = subprocess.run(["nm", "-D", "--defined-only", plugin], capture_output=True, text=True, check=True)
    assert done.stdout == ""


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    if not shutil.which("patchelf"):
        pytest.skip("there is no patchelf")
    built = hydraHosts.Built(hydraBuild.folder("plugin"), os.path.join(os.environ["PATINA_BUILD_DIR"], "python"),
                             os.path.join(hydraBuild.folder("root"), "lib"),
                             divmod(int(hydraBuild.folder("version")) % 10000, 100), "host")
    with pluginPackage.whole(built) as folder:
        yield folder


def test_a_package_needs_only_its_host_and_the_system(package):
    python = hydraBuild.folder("python")
    if not os.path.exists(python):
        pytest.skip("this OpenUSD has no Python")
    done = subprocess.run([python, "-c", LOAD, package], env=hydraBuild.environment(), capture_output=True, text=True,
                          check=False)
    assert done.returncode == 0, done.stderr
    loaded = {os.path.basename(path): path for path in done.stdout.split()}
    brought = set(os.listdir(os.path.join(package, "lib")))
    assert "hdPatina.so" in loaded and any(name.startswith("libOpenImageIO.so") for name in brought & set(loaded))
    assert not [path for name, path in loaded.items() if name in brought and not path.startswith(package + os.sep)]
    assert not any(name.startswith("libusd") for name in brought)
    assert any(name.startswith("libopenimageio") for name in os.listdir(os.path.join(package, "licences")))


def test_a_package_tries_images_by_its_own_programs(package):
    for name in ("patinaTryImage", "patinaReadField"):
        done = subprocess.run([os.path.join(package, name)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=False)
        assert done.returncode not in (126, 127), done.stderr
