# SPDX-License-Identifier: Apache-2.0
"""One film that `patina record` renders, and the files that it is written to."""
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Output:
    """A file of a shot."""
    image: str
    aovs: tuple  # names in the file's order, color and alpha among them where it holds them
    half: bool = False  # OpenEXR: colour as 16-bit floats
    deep: bool = False  # the film's samples by their depths


@dataclass
class Shot:
    """One film."""
    frame: object  # time code, or None for the default time
    outputs: list
    camera: object = None  # path or name; None: the stage's own
    size: tuple = (None, None)  # pixels; what is None follows from the camera
    settings: dict = field(default_factory=dict)  # render settings that differ from those of the command
    page: object = None  # of --report
    prim: str = ""  # path of the product that it comes from, for messages

    @property
    def image(self):
        """The file that the render goes by: checkpoints lie beside it."""
        return self.outputs[0].image

    @property
    def images(self):
        return [output.image for output in self.outputs]

    @property
    def deep(self):
        return any(output.deep for output in self.outputs)

    def aovs(self):
        """:returns: names besides color and alpha that some file holds"""
        names = [name for output in self.outputs for name in output.aovs]
        return [name for name in dict.fromkeys(names) if name not in ("color", "alpha")]
