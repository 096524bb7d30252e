# SPDX-License-Identifier: Apache-2.0
"""Options of the reader, and its report."""
from dataclasses import dataclass, field


@dataclass
class StageOptions:
    """How to read a stage.

    frame: time code, or None for default values
    purposes: drawn besides those of purpose "default"
    default_purpose: whether these are drawn
    complexity: of usdrecord: a name (low, medium, high, veryhigh) or 1.0 ... 1.3 and more; each 0.1
        is one level of subdivision
    camera: path or name; None takes the stage's own (render settings, main_cam, the first), and
        frames the stage when there is none
    shutter: (open, close) in time codes relative to the frame; None takes the camera's
    motion: also read where things are a frame before and after, for the AOVs of motion
    headlight: light a stage that has no lights
    rendering_color_space: linear space of the scene's colours; '' is linear Rec.709
    render_pass: path of a UsdRenderPass, whose collections say what is drawn
    matte_names: native instances get names of their own, for Cryptomatte
    levels: path of a root of levels of detail -> index of the level that is drawn, where no override says so
    material_purpose: whose bindings are looked at before those for all purposes: full, preview, or '' for these alone
    """
    frame: object = None
    purposes: tuple = ("default", "render")
    default_purpose: bool = True
    complexity: object = 1.0
    camera: object = None
    shutter: object = None
    motion: bool = False
    headlight: bool = True
    material_purpose: str = "full"
    matte_names: bool = False
    render_pass: object = None
    rendering_color_space: str = ""
    levels: dict = field(default_factory=dict)

    @property
    def refine_level(self):
        names = {"low": 0, "medium": 1, "high": 2, "veryhigh": 3}
        if self.complexity in names:
            return names[self.complexity]
        return min(max(round((float(self.complexity) - 1.0) * 10.0), 0), 8)


@dataclass
class StageInfo:
    """The report of a reading."""
    camera: str = ""  # path in the scene
    cameras: list = field(default_factory=list)
    framed: bool = False  # the stage had no camera
    headlight: bool = False  # the stage had no lights
    uses_camera: bool = False  # for another camera the scene would be another, apart from the headlight
    up_axis: str = "Y"
    meters_per_unit: float = 0.01
    start_time_code: float = 0.0
    end_time_code: float = 0.0
    time_codes_per_second: float = 24.0
    shutter: tuple = (0.0, 0.0)  # relative to the frame
    counts: dict = field(default_factory=dict)  # prims by kind
    notes: list = field(default_factory=list)  # what was decided for the user, one line each
