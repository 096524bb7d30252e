# SPDX-License-Identifier: Apache-2.0
"""The bill of materials of release files, as SPDX 2.3 in JSON: which packages each file contains, and which it asks for."""
import datetime
import email
import json
import os
import re
import subprocess
import tarfile
import urllib.parse
import zipfile

from patina import __version__
from patina.cli import bundledLibraries
from patina.farm import digests

_PAGE = "page.js"  # the material page's script, which holds the packages of its package-lock.json
_LOCK = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "view", "web", "package-lock.json")


def write(path, files, commit, time):
    """:param path: of the bill
    :param files: of the release: wheels, .deb, .tar.gz, .zip
    :param commit: that they are made from
    :param time: of the commit, seconds"""
    packages, relationships = {}, []

    def relate(one, kind, other):
        relationships.append({"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other})

    for file in files:
        name = os.path.basename(file)
        own = _id(name)
        packages[own] = _package(name, own, __version__, packageFileName=name, licenseDeclared="Apache-2.0",
                                 checksums=[{"algorithm": "SHA256", "checksumValue": digests.content(file)}],
                                 sourceInfo=f"made from commit {commit}")
        relate("SPDXRef-DOCUMENT", "DESCRIBES", own)
        members = _members(file)
        for kind, part in ([("CONTAINS", part) for part in _contained(members)] +
                           [("DEPENDS_ON", part) for part in _required(file)]):
            packages.setdefault(part["SPDXID"], part)
            relate(own, kind, part["SPDXID"])
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"hdPatina-{__version__}",
        "documentNamespace": f"https://spdx.org/spdxdocs/hdPatina-{__version__}-{commit}",
        "creationInfo": {"created": datetime.datetime.fromtimestamp(time, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "creators": [f"Tool: patina-{__version__}"]},
        "packages": list(packages.values()), "relationships": relationships}
    with open(path, "w", encoding="utf-8") as out:
        json.dump(document, out, indent=1)
        out.write("\n")


def _id(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", name)


def _package(name, own, version=None, **fields):
    return {"name": name, "SPDXID": own, **({"versionInfo": version} if version else {}), "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
            "copyrightText": "NOASSERTION", **fields}


def _from(manager, name, version=None, **fields):
    """:returns: a package that others publish, known by its package URL"""
    url = f"pkg:{manager}/{urllib.parse.quote(name)}" + (f"@{urllib.parse.quote(version)}" if version else "")
    return _package(name, _id(url), version, externalRefs=[
        {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": url}], **fields)


def _members(file):
    """:returns: paths in an archive"""
    if file.endswith((".whl", ".zip")):
        with zipfile.ZipFile(file) as archive:
            return archive.namelist()
    if file.endswith(".deb"):
        return _run("dpkg-deb", "--contents", file).splitlines()
    with tarfile.open(file) as archive:
        return archive.getnames()


def _contained(members):
    """:returns: packages whose files are in an archive: Debian's, by the licences that lie beside them, and the page's"""
    found = []
    names = sorted({os.path.basename(path) for path in members
                    if os.path.basename(os.path.dirname(path)) == bundledLibraries.LICENCES and not path.endswith("/")})
    if names:
        versions = dict(line.split("\t") for line in
                        _run("dpkg-query", "-W", "-f=${Package}\t${Version}\n", *names).splitlines())
        found += [_from("deb/debian", name, versions.get(name),
                        comment=f"Its licences are in {bundledLibraries.LICENCES}/{name} of the file.") for name in names]
    if any(os.path.basename(path) == _PAGE for path in members):
        with open(_LOCK, encoding="utf-8") as file:
            locked = json.load(file)["packages"]
        found += [_from("npm", name, locked[f"node_modules/{name}"]["version"],
                        licenseDeclared=locked[f"node_modules/{name}"].get("license", "NOASSERTION"))
                  for name in sorted(locked[""]["dependencies"])]
    return found


def _required(file):
    """:returns: packages that an installer fetches for a file"""
    if file.endswith(".whl"):
        with zipfile.ZipFile(file) as archive:
            (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
            metadata = email.message_from_bytes(archive.read(name))
        asked = [text for text in metadata.get_all("Requires-Dist", []) if "extra ==" not in text]
        return [_from("pypi", re.match(r"[\w.-]+", text).group(0).lower()) for text in asked]
    if file.endswith(".deb"):
        asked = _run("dpkg-deb", "--field", file, "Depends")
        return [_from("deb/debian", name) for name in dict.fromkeys(re.findall(r"(?:^|, *)([a-z0-9][a-z0-9.+-]+)", asked))]
    return []


def _run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout
