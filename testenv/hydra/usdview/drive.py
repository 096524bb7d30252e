# SPDX-License-Identifier: Apache-2.0
"""Drives usdview as a user would, on a screen that no one sees: opens a stage with a renderer, turns the
camera, picks a prim, changes a material and takes screenshots.

    xvfb-run python drive.py FOLDER STAGE --renderer Patina [--defaultsettings ...]

Everything after FOLDER is usdview's. Writes start.png, turned.png, edited.png (the view), the same of the whole window
(startWindow.png, ...) and result.json to FOLDER. $PATINA_DRIVE_SIZE is the size of the view, 480x360 if not given. With
$PATINA_DRIVE_FRAMES=N the turn is made in N moves, and the first image after each is saved too (move0.png, ...).
Runs in the Python of OpenUSD. The stage has to have a shader at the path that $PATINA_DRIVE_SHADER names,
with the colour input that $PATINA_DRIVE_INPUT names.
"""
import json
import os
import sys
import time

from pxr import Gf, Sdf, Usdviewq, UsdShade
from pxr.Usdviewq.qt import QtCore, QtWidgets

PATIENCE = 120.0  # seconds until a picture has to be whole
SIZE = tuple(map(int, os.environ.get("PATINA_DRIVE_SIZE", "480x360").split("x")))  # of the view, in points of the screen


class Driver:
    def __init__(self, controller, folder):
        self.controller, self.folder = controller, folder
        self.view = controller._stageView
        self.result = {"shots": []}

    def run(self):
        self.view.setFixedSize(*SIZE)
        # Some releases of PySide lose a reference to None with each line of text that is drawn.
        self.controller._dataModel.viewSettings.showHUD = False
        self.shoot("start")
        self.result["renderer"] = self.view.GetCurrentRendererId()
        self.result["stats"] = {name: str(value) for name, value in self.view._getRenderer().GetRenderStats().items()}
        self.pick()
        self.turn()
        self.shoot("turned")
        self.edit()
        self.shoot("edited")
        with open(os.path.join(self.folder, "result.json"), "w", encoding="utf-8") as file:
            json.dump(self.result, file, indent=1)

    def events(self):
        for _ in range(10):
            QtWidgets.QApplication.processEvents()

    def shoot(self, name):
        """Waits until the picture is whole and saves it."""
        end = time.monotonic() + PATIENCE
        self.view.updateView()
        self.events()
        while not self.view._getRenderer().IsConverged() and time.monotonic() < end:
            self.events()
            time.sleep(0.01)
        self.events()
        self.view.updateView()  # the last pixels come with the repaint after the last sample
        self.events()
        self.controller.GrabViewportShot().save(os.path.join(self.folder, name + ".png"), "PNG")
        self.controller.GrabWindowShot().save(os.path.join(self.folder, name + "Window.png"), "PNG")
        self.result["shots"].append({"name": name, "converged": self.view._getRenderer().IsConverged()})

    def pick(self):
        """Clicks on the middle of the view. The prim there goes to the result, and the selection."""
        ratio = self.view.devicePixelRatioF()
        x, y = SIZE[0] / 2 * ratio, SIZE[1] / 2 * ratio
        found = self.view.pick(self.view.computePickFrustum(x, y)[1])
        if found and hasattr(found[0], "hitPrimPath"):  # since 26.08 a list of hits, before that the parts of one
            self.result["picked"] = str(found[0].hitPrimPath)
        else:
            self.result["picked"] = str(found[2]) if found else ""
        self.view.pickObject(x, y, QtCore.Qt.LeftButton, QtCore.Qt.NoModifier)
        self.events()
        self.result["selected"] = str(self.controller._dataModel.selection.getFocusPrim().GetPath())
        self.controller._dataModel.selection.clear()

    def turn(self):
        """As a drag with the left mouse button does."""
        settings = self.controller._dataModel.viewSettings
        self.view.switchToFreeCamera()
        frames = int(os.environ.get("PATINA_DRIVE_FRAMES", "1"))
        for i in range(frames):
            settings.freeCamera.Tumble(40.0 / frames, 15.0 / frames)
            if frames > 1:
                self.look(f"move{i}")

    def look(self, name):
        """Saves the first image that is shown after a move, whole or not."""
        end = time.monotonic() + PATIENCE
        self.view.updateView()
        self.events()
        while not self.view._getRenderer().GetRenderStats().get("patina:imagesShown") and time.monotonic() < end:
            time.sleep(0.005)
            self.view.updateView()
            self.events()
        self.controller.GrabViewportShot().save(os.path.join(self.folder, name + ".png"), "PNG")

    def edit(self):
        stage = self.controller._dataModel.stage
        shader = UsdShade.Shader(stage.GetPrimAtPath(os.environ["PATINA_DRIVE_SHADER"]))
        shader.CreateInput(os.environ["PATINA_DRIVE_INPUT"], Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0.9, 0.05, 0.02))


class Launcher(Usdviewq.Launcher):
    """usdview's own launcher, but driven: it ends when the driver does."""

    def __init__(self, folder):
        super().__init__()
        self.folder = folder

    def LaunchProcess(self, arg_parse_result, app, appController):
        try:
            app.processEvents()
            Driver(appController, self.folder).run()
        finally:
            app.processEvents()
            appController._stageView.closeRenderer()
            app.instance().closeAllWindows()
            app.processEvents()


if __name__ == "__main__":
    out = sys.argv.pop(1)
    Launcher(out).Run()
    sys.stdout.flush()
    os._exit(0)  # the same loss of references would end the interpreter with an abort
