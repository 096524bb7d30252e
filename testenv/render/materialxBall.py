# SPDX-License-Identifier: Apache-2.0
"""A ball under a white sky, drawn by the GLSL that MaterialX itself makes of a document.

    xvfb-run -a python materialxBall.py DOCUMENT [MATERIAL ...]

Prints JSON: material -> mean RGB over the ball, which an orthographic camera sees. MaterialX draws with importance samples of
each lobe (its FIS); under a sky of one colour their mean is the lobe's directional albedo, as its shaders approximate it.
"""
import json
import math
import os
import sys
import tempfile

import MaterialX as mx
from MaterialX import PyMaterialXGenGlsl, PyMaterialXGenShader, PyMaterialXRender, PyMaterialXRenderGlsl

SIZE = 48  # pixels
SAMPLES = 64  # per lobe
ROWS = 96  # of the mesh


def write_ball(path):
    """A sphere of radius 1 as OBJ: MaterialX's Python has no way to fill a mesh."""
    columns = 2 * ROWS
    with open(path, "w", encoding="ascii") as file:
        for i in range(ROWS + 1):
            for j in range(columns + 1):
                theta, phi = math.pi * i / ROWS, 2.0 * math.pi * j / columns
                point = "%.7g %.7g %.7g" % (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi))
                file.write(f"v {point}\nvn {point}\nvt {j / columns:.7g} {1.0 - i / ROWS:.7g}\n")
        for i in range(ROWS):
            for j in range(columns):
                a, c = i * (columns + 1) + j + 1, (i + 1) * (columns + 1) + j + 1
                for triangle in ((a, a + 1, c + 1), (a, c + 1, c)):
                    file.write("f " + " ".join(f"{k}/{k}/{k}" for k in triangle) + "\n")


def read(path):
    """:returns: the document, with MaterialX's own definitions"""
    definitions, document = mx.createDocument(), mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), definitions)
    mx.readFromXmlFile(document, path)
    document.setDataLibrary(definitions)
    return document


def make_renderer(ball, textures):
    render = PyMaterialXRender
    renderer = PyMaterialXRenderGlsl.GlslRenderer.create(SIZE, SIZE, render.FLOAT)
    renderer.initialize()
    images = PyMaterialXRenderGlsl.GLTextureHandler.create(render.StbImageLoader.create())
    images.setSearchPath(mx.FileSearchPath(textures))
    renderer.setImageHandler(images)
    sky = render.createUniformImage(64, 32, 3, render.FLOAT, mx.Color4(1.0, 1.0, 1.0, 1.0))
    light = render.LightHandler.create()
    light.setEnvRadianceMap(sky)
    light.setEnvIrradianceMap(sky)
    light.setEnvSampleCount(SAMPLES)
    renderer.setLightHandler(light)
    geometry = renderer.getGeometryHandler()
    geometry.addLoader(render.TinyObjLoader.create())
    geometry.loadGeometry(mx.FilePath(ball), False)
    camera = renderer.getCamera()
    # The shaders take the direction to the camera's place, so that it has to be far away.
    camera.setViewMatrix(render.Camera.createViewMatrix(mx.Vector3(0, 0, 1e3), mx.Vector3(0, 0, 0), mx.Vector3(0, 1, 0)))
    camera.setProjectionMatrix(render.Camera.createOrthographicMatrix(-1.0, 1.0, -1.0, 1.0, 990.0, 1010.0))
    camera.setWorldMatrix(mx.Matrix44.IDENTITY)
    return renderer


def mean(image):
    """:returns: RGB over the disc, without the border's pixels, which show what is behind as well"""
    found = []
    for y in range(SIZE):
        for x in range(SIZE):
            if math.hypot(2.0 * (x + 0.5) / SIZE - 1.0, 2.0 * (y + 0.5) / SIZE - 1.0) < 1.0 - 2.0 / SIZE:
                color = image.getTexelColor(x, y)
                found.append([color[i] for i in range(3)])
    return [sum(column) / len(found) for column in zip(*found)]


def main():
    document = read(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        ball = os.path.join(folder, "ball.obj")
        write_ball(ball)
        renderer = make_renderer(ball, os.path.dirname(os.path.abspath(sys.argv[1])))
    generator = PyMaterialXGenGlsl.GlslShaderGenerator.create()
    context = PyMaterialXGenShader.GenContext(generator)
    context.registerSourceCodeSearchPath(mx.getDefaultDataSearchPath())
    context.getOptions().hwSpecularEnvironmentMethod = PyMaterialXGenShader.HwSpecularEnvironmentMethod.SPECULAR_ENVIRONMENT_FIS
    means = {}
    for material in document.getMaterialNodes():
        if not sys.argv[2:] or material.getName() in sys.argv[2:]:
            renderer.createProgram(generator.generate("ball", mx.getShaderNodes(material)[0], context))
            renderer.validateInputs()
            renderer.render()
            means[material.getName()] = mean(renderer.captureImage(None))
    print(json.dumps(means))


if __name__ == "__main__":
    main()
