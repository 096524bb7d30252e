# SPDX-License-Identifier: Apache-2.0
"""Times Storm in usdrecord's frame recorder: python stormTimes.py STAGE WIDTH [CAMERA [PRIM.INPUT=NUMBERS]], in the
Python of OpenUSD and with a screen. Prints one line of JSON: seconds until the first image, after a camera move and after
an edit of the input where one is given, and peak memory."""
import json
import os
import resource
import statistics
import sys
import tempfile
import time

from pxr import Gf, Usd, UsdAppUtils, UsdGeom
from PySide6 import QtCore, QtOpenGL, QtWidgets
from PySide6.QtGui import QOffscreenSurface, QOpenGLContext

MOVES = 5


def context():
    """:returns: what has to stay alive while GL is used"""
    application = QtWidgets.QApplication(sys.argv[:1])
    surface = QOffscreenSurface()
    surface.create()
    made = QOpenGLContext()
    if not made.create() or not made.makeCurrent(surface):
        sys.exit("there is no OpenGL context")
    frame = QtOpenGL.QOpenGLFramebufferObject(QtCore.QSize(1, 1))  # for the task that presents
    frame.bind()
    return application, surface, made, frame


def editor(stage, text):
    """:returns: a function of the step's number that changes an input, None without one"""
    if not text:
        return None
    target, numbers = text.split("=")
    path, name = target.rsplit(".", 1)
    attribute = stage.GetPrimAtPath(path).GetAttribute("inputs:" + name)
    numbers = [float(x) for x in numbers.split(",")]

    def change(step):
        values = [x * (0.5 + 0.5 * step / MOVES) for x in numbers]
        attribute.Set(type(attribute.Get())(*values))
    return change


def main(path, width, camera="/camera", edit=""):
    alive = context()
    stage = Usd.Stage.Open(path)
    camera = UsdGeom.Camera(stage.GetPrimAtPath(camera))
    change = editor(stage, edit)
    move = UsdGeom.Xformable(camera).AddTranslateOp(opSuffix="move")
    move.Set(Gf.Vec3d(0.0))
    with tempfile.TemporaryDirectory() as folder:
        image = os.path.join(folder, "image.png")
        seconds, edited = [], []
        recorder = None
        for step in range(MOVES + 1):
            if step and change:
                change(step)
                start = time.perf_counter()
                recorder.Record(stage, camera, Usd.TimeCode.Default(), image)
                edited.append(time.perf_counter() - start)
            move.Set(Gf.Vec3d(0.01 * step, 0, 0))
            start = time.perf_counter()
            if recorder is None:
                recorder = UsdAppUtils.FrameRecorder("HdStormRendererPlugin", True)
                recorder.SetImageWidth(width)
            if not recorder.Record(stage, camera, Usd.TimeCode.Default(), image):
                sys.exit("Storm makes no image")
            seconds.append(time.perf_counter() - start)
        recorder = None
    found = {"first": seconds[0], "moved": statistics.median(seconds[1:]),
             "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024}
    if edited:
        found["edited"] = statistics.median(edited)
    print(json.dumps(found), flush=True)
    del alive
    os._exit(0)  # some releases of PySide abort when the interpreter ends


main(sys.argv[1], int(sys.argv[2]), *sys.argv[3:])
