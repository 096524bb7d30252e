# SPDX-License-Identifier: Apache-2.0
"""All fuzzers, by name."""
from collections import namedtuple

Fuzzer = namedtuple("Fuzzer", "kind reads share sources leaks", defaults=(True,))
"""kind: native (libFuzzer), python (atheris) or generated; reads: what is tried; share: of the time; sources: files whose lines
are counted; leaks: whether memory that is lost counts. The readers of image formats lose some, and to tell theirs takes a
hundred times as long."""

FUZZERS = {
    "mtlx": Fuzzer("native", "bytes as a MaterialX document; its materials as programs and GLSL", 2,
                   ("materialNetwork/mtlx/",)),
    "mtlxIncludes": Fuzzer("native", "bytes as MaterialX documents that include each other, by names of any kind", 1,
                           ("materialNetwork/mtlx/include.cpp", "materialNetwork/mtlx/document.cpp",
                            "materialNetwork/mtlx/xmlFile.cpp", "base/regularFile.cpp")),
    "network": Fuzzer("native", "networks of all nodes, with any value and connection, as programs and GLSL", 2,
                      ("materialNetwork/graph/", "materialNetwork/ir/", "materialNetwork/plan/", "materialNetwork/cpu/",
                       "materialNetwork/glsl/", "materialNetwork/nodes/")),
    "ies": Fuzzer("native", "bytes as an IES profile", 1, ("hdDelegate/image/iesProfile.cpp",)),
    "film": Fuzzer("native", "bytes as a checkpoint or a part of a frame, with right checksums", 1,
                   ("hdDelegate/film/filmFile.cpp", "hdDelegate/film/filmStream.cpp", "hdDelegate/film/partial.cpp",
                    "hdDelegate/film/checkpoint.cpp")),
    "parts": Fuzzer("native", "bytes as several parts of a frame, which are merged", 1,
                    ("hdDelegate/film/filmFile.cpp", "hdDelegate/film/filmStream.cpp", "hdDelegate/film/partial.cpp",
                     "hdDelegate/film/relativeError.cpp")),
    "image": Fuzzer("native", "bytes as an image: its size, channels and metadata", 1, ("hdDelegate/film/readImage.cpp",
                                                                                     "base/utf8.cpp"), False),
    "texture": Fuzzer("native", "bytes as a texture, read whole and by tiles", 2,
                      ("hdDelegate/image/textureFile.cpp", "hdDelegate/image/imageTextureLoad.cpp",
                       "hdDelegate/image/fileColorSpace.cpp", "hdDelegate/image/iccProfile.cpp",
                       "hdDelegate/image/fileTiles.cpp", "hdDelegate/image/texelConversion.cpp"), False),
    "stageReader": Fuzzer("python", "bytes as the choices that make a legal stage, which is read and not rendered", 2,
                          ("plugin/patina/stage/",)),
    "package": Fuzzer("python", "bytes as a usdz package, whose files are copied out of it", 1,
                      ("plugin/patina/stage/assets.py",)),
    "commandParser": Fuzzer("python", "bytes as the choices that make a command line, which is parsed and not run", 1,
                            ("plugin/patina/cli/main.py", "plugin/patina/cli/recordFlags.py",
                             "plugin/patina/cli/settingFlags.py", "plugin/patina/cli/errors.py")),
    "randomStages": Fuzzer("generated", "legal stages of all prim types with extreme values, rendered", 4, ()),
    "backEndPairs": Fuzzer("generated", "legal stages that both back ends draw, held together per tile", 4, ()),
    "materialDocuments": Fuzzer("generated", "legal MaterialX documents of all nodes, explained and evaluated", 2, ()),
    "edits": Fuzzer("generated", "random edits while an image is rendered", 2, ()),
    "commandLines": Fuzzer("generated", "every flag of the commands that read files", 2, ()),
    "faults": Fuzzer("generated", "the n-th call that writes, reads, maps or asks for memory fails", 2, ()),
    "changing": Fuzzer("generated", "files change while they are read", 2, ()),
    "killed": Fuzzer("generated", "kill -9 at random moments of a render that is resumed", 2, ()),
}
