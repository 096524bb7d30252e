"""From the arguments of `patina view` to the text of a page."""
from patina.cli import materials as reader
from patina.cli import methods, statistics
from patina.cli.errors import CommandError
from patina.view import materials, page, surroundings

MOST_MATERIALS = 64


def page_of(arguments):
    """:returns: the page's text, and warnings as lines"""
    chosen = methods.parse(arguments.method)
    warnings, built, lobes = [], [], []
    textures = materials.Textures(arguments.textureSize)
    for argument in arguments.material:
        found, reading = reader.load(argument, arguments.set, every=True)
        warnings += statistics.lines(reading)
        for name, network in found:
            if len(built) == MOST_MATERIALS:
                raise CommandError(f"a page shows at most {MOST_MATERIALS} materials")
            material, used, texts = materials.build(_short(name), network, chosen, textures)
            built.append(material)
            lobes += used
            warnings += [f"{name}: {text}" for text in texts]
    radius, target, z_up = 1.0, (0.0, 0.0, 0.0), False
    camera, eye = surroundings.camera(radius, target, z_up)
    data = {"title": arguments.title or ", ".join(m["name"] for m in built[:4]), "materials": built,
            "textures": textures.entries, "lights": [], "camera": camera,
            "environments": surroundings.environments(arguments.environment, [], arguments.textureSize, z_up),
            "shapes": surroundings.built_in_shapes(radius, target, z_up),
            "start": {"material": 0, "shape": 0, "environment": 0, "rotation": 0.0, "environmentGain": 1.0,
                      "ambient": [0.0, 0.0, 0.0], "exposure": 0.0, "samples": 64, "backdrop": True,
                      "backdropColor": [0.18, 0.18, 0.18], "eye": eye}}
    return page.document(data, lobes), warnings


def _short(name):
    return name.rpartition("/")[2] or name
