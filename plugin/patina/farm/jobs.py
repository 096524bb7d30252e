# SPDX-License-Identifier: Apache-2.0
"""Job templates of Open Job Description (2023-09): frames, parts and merges as steps, for schedulers that take them."""
import json
import os

import patina
from patina.cli import outputs
from patina.cli.errors import CommandError, UsageError
from patina.farm import identity

VERSION = "jobtemplate-2023-09"
LONGEST_NAME = 64  # of a job, by the specification
MAX_TEXT = 1024  # characters of a parameter's value, by the specification
_FILES = ("--layer", "--sessionLayer", "--report")  # flags of files: a task runs in a folder of its own
MAX_VALUES = 1024  # of a parameter that is a list, by the specification


def write(file, arguments, record, shots):
    """:param arguments: of `patina farm`
    :param record: parsed arguments of `patina record`
    :param shots: list of (time code, image)"""
    if not file.lower().endswith((".yaml", ".yml", ".json")):
        raise UsageError(f"patina farm: --write-job {file}: an Open Job Description is a .yaml or a .json file")
    value = template(arguments, record, shots, os.path.dirname(os.path.abspath(file)))
    if file.lower().endswith(".json"):
        text = json.dumps(value, indent=2) + "\n"
    else:
        try:
            import yaml
        except ImportError as error:
            raise CommandError(f"--write-job of a .yaml file needs PyYAML (write a .json file): {error}") from error
        text = yaml.safe_dump(value, sort_keys=False, width=120, allow_unicode=True)
    outputs.write_text(file, text)


def template(arguments, record, shots, folder):
    """:param folder: of the template, which its default paths begin in
    :returns: the job as a dict"""
    frames = _frames([time for time, _ in shots]) if arguments.frames else None
    parameters = [
        {"name": "Patina", "type": "STRING", "default": _launcher(), "description": "the command"},
        _path("Stage", "FILE", "IN", record.stage, folder, "the stage"),
        _path("Image", "FILE", "OUT", record.image, folder,
              "with a place for the frame, as `patina record` takes it" if frames else "what is written"),
    ]
    if frames and frames["type"] == "INT" and len(frames["range"]) > MAX_TEXT:
        raise CommandError(f"--write-job: the list of frames is longer than a parameter of a job template ({MAX_TEXT} "
                           "characters); write several jobs")
    if frames and frames["type"] == "INT":
        parameters.append({"name": "Frames", "type": "STRING", "default": frames["range"],
                           "description": "such as 1-240 or 1-9:2,20"})
        frames = dict(frames, range="{{Param.Frames}}")
    flags = _flags(arguments)
    if arguments.cut.parts == 1:
        # A task that is told to end leaves no image that would pass for a whole one.
        flags += ["--onlyWhole", "--resume"] if arguments.resume else ["--onlyWhole"]
        steps = [_step("Frames", ["record", "{{Param.Stage}}", "{{Param.Image}}", *flags, *_frame_flag(frames)], frames)]
    else:
        parameters.append(_path("Parts", "DIRECTORY", "INOUT", record.image + ".parts", folder, "parts until they are merged"))
        steps = _cut_steps(arguments, flags, frames)
    name = f"patina {os.path.basename(record.stage)}".translate(str.maketrans("{}", "()"))[:LONGEST_NAME]
    return {"specificationVersion": VERSION, "name": name, "parameterDefinitions": parameters, **_environments(),
            "steps": steps}


def _environments():
    """:returns: the variables of this command's environment that images depend on, as the template has them"""
    variables = {name: value for name, value in identity.environment().items() if value}
    for name, value in variables.items():
        if "{{" in value or "}}" in value:
            raise CommandError(f"--write-job: ${name}: a job template takes double braces for an expression")
    return {"jobEnvironments": [{"name": "Patina", "variables": variables}]} if variables else {}


def _path(name, kind, flow, path, folder, description):
    """:returns: the definition of a parameter. The specification joins defaults of paths to the template's folder and lets
        none lead out of it; what lies elsewhere is a text"""
    relative = os.path.relpath(path, folder)
    if relative.split(os.sep)[0] == os.pardir:
        return {"name": name, "type": "STRING", "default": os.path.abspath(path), "description": description}
    return {"name": name, "type": "PATH", "objectType": kind, "dataFlow": flow, "default": relative, "description": description}


def _cut_steps(arguments, flags, frames):
    whole = arguments.cut
    name = "{{Param.Parts}}/" + ("{{Task.Param.Frame}}." if frames else "") + "%s.part"
    part = ["record", "{{Param.Stage}}", "{{Param.Image}}", *flags, *_frame_flag(frames),
            "--part={{Task.Param.Part}}/" + str(whole), "--partial=" + name % "{{Task.Param.Part}}"]
    merge = ["merge", *(name % number for number in range(1, whole.parts + 1)), "{{Param.Image}}"]
    if arguments.allowMixed:
        merge.append("--allowMixed")
    return [_step("Parts", part, frames, {"name": "Part", "type": "INT", "range": f"1-{whole.parts}"}),
            dict(_step("Merge", merge, frames), dependencies=[{"dependsOn": "Parts"}])]


def _step(name, command, *definitions):
    step = {"name": name}
    definitions = [dict(definition) for definition in definitions if definition]
    if definitions:
        step["parameterSpace"] = {"taskParameterDefinitions": definitions}
    step["script"] = {"actions": {"onRun": {"command": "{{Param.Patina}}", "args": command}}}
    return step


def _frame_flag(frames):
    return ["--frames={{Task.Param.Frame}}"] if frames else []


def _frames(times):
    """:returns: the definition of the task parameter Frame"""
    if all(float(time).is_integer() for time in times):
        return {"name": "Frame", "type": "INT", "range": _range([int(time) for time in times])}
    if len(times) > MAX_VALUES:
        raise CommandError(f"--write-job: {len(times)} frames between whole ones are more than a job template lists "
                           f"({MAX_VALUES})")
    return {"name": "Frame", "type": "FLOAT", "range": [round(float(time), 6) for time in times]}


def _range(numbers):
    """:returns: the range expression of whole numbers, ascending, each once"""
    numbers, parts = sorted(set(numbers)), []
    while numbers:
        step = numbers[1] - numbers[0] if len(numbers) > 1 else 1
        count = 1
        while count < len(numbers) and numbers[count] - numbers[count - 1] == step:
            count += 1
        if count < 3 and step > 1:
            count = 1
        last = numbers[count - 1]
        parts.append(str(numbers[0]) if count == 1 else f"{numbers[0]}-{last}" + (f":{step}" if step > 1 else ""))
        numbers = numbers[count:]
    return ",".join(parts)


def _flags(arguments):
    """:returns: flags of `patina record` that the user has given, without stage and image"""
    flags, takes = [], False
    for word in arguments.record_words:
        flag, equals, file = word.partition("=")
        if takes:
            word = os.path.abspath(word)
        elif flag in _FILES and equals:
            word = f"{flag}={os.path.abspath(file)}"
        takes = not takes and word in _FILES
        if "{{" in word or "}}" in word:
            raise CommandError(f"--write-job: {word}: a job template takes double braces for an expression")
        flags.append(word)
    threads = [f"--threads={arguments.threads}"] if arguments.threads else []
    return flags + threads + ["--quiet"]


def _launcher():
    """:returns: the launcher of a checkout, or the command's name where Patina is installed"""
    launcher = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(patina.__file__)))), "patina")
    return launcher if os.path.isfile(launcher) else "patina"
