# SPDX-License-Identifier: Apache-2.0
"""Chooses the command, turns errors into one line and an exit status: 0 done, 1 failed, 2 usage, 75 try again."""
import argparse
import importlib
import os
import re
import sys
import traceback

from patina import __version__, inputs, limits
from patina.cli import causes, colours, interrupts, standardStreams, usageHints
from patina.cli.errors import FAILED, TEMPORARY, USAGE, CommandError, UsageError, is_temporary

_MODULES = {"test": "testRun"}  # commands whose module is called otherwise
_BATCH = ("record", "merge", "denoise", "farm")  # what schedulers run: a signal that ended one may pass

# Name, which is that of a module of patina.cli with add_arguments(parser) and run(arguments), -> what it does.
COMMANDS = {
    "record": "render a stage to images",
    "merge": "put the parts of a cut frame together",
    "denoise": "denoise the frames of a sequence, each with those around it",
    "farm": "render frames and parts of them on many machines",
    "explain": "show how a material is modelled, and which parts are left out",
    "check": "test energy, sampling, densities and finite numbers of materials",
    "bake": "write a material as another shading model, with textures",
    "bsdf": "print values, samples and albedo of a material",
    "shader": "write a material as shader text or as a MaterialX document",
    "view": "write a page that shows materials in a browser, with sliders",
    "compare": "measure how two images differ",
    "hydra": "show where the Hydra plugin is, and whether hosts can use it",
    "bench": "measure speed and memory, beside other renderers",
    "chart": "measure and draw the cost and the error of methods",
    "docs": "build the site of a checkout: tutorials, gallery, reference",
    "release": "make the packages of a checkout, with checksums and a bill of materials",
    "completion": "print what makes bash or zsh complete commands and flags",
    "fuzz": "run the fuzzers of a checkout for a time",
    "test": "run the tests of a checkout, by tier and room",
}


class _Parser(argparse.ArgumentParser):
    """Flags are never guessed from their beginnings: a script would break when one is added."""

    def __init__(self, **keywords):
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **keywords)
        self.words = []  # that were typed

    def error(self, message):
        raise UsageError(f"{self.prog}: {message}{usageHints.hint(self, self.words, message)} (see {self.prog} --help)")


def _normalise(argv):
    """Makes plain what argparse would misread: `--json` without a file before a positional
    argument, and values such as -0.5,0,1 that begin like an option."""
    out = []
    for argument in argv:
        if argument == "--json":
            argument = "--json=-"
        if (out and re.match(r"-[\d.]", argument) and re.fullmatch(r"--?[A-Za-z][\w-]*", out[-1])):
            out[-1] += "=" + argument if out[-1].startswith("--") else argument
            continue
        out.append(argument)
    return out


def _overview():
    lines = ["usage: patina COMMAND ...", "", "Renders USD stages with physically based shading networks.", "",
             "commands:"]
    lines += [f"  {name:<10}{text}" for name, text in COMMANDS.items()]
    lines += ["", "`patina COMMAND --help` tells everything about one of them.",
              "Exit status: 0 done, 1 failed with a one-line reason, 2 wrong usage, 75 failed for a reason that may pass",
              "(a full disk, memory, a lost device) or ended by a signal with all saved: the same may work again."]
    return "\n".join(lines)


def _check_arguments(argv):
    for argument in argv:
        try:
            argument.encode()
        except UnicodeEncodeError:
            shown = argument.encode(errors="surrogateescape").decode(errors="replace")
            raise UsageError(f"patina: {shown}: names that are not UTF-8 are neither read nor written") from None


def module_of(command):
    return importlib.import_module("patina.cli." + _MODULES.get(command, command))


def _dispatch(argv):
    if not argv or argv[0] in ("-h", "--help", "help"):
        if len(argv) > 1 and argv[0] == "help":
            return _dispatch([argv[1], "--help"])
        print(_overview(), file=sys.stdout if argv else sys.stderr)
        return 0 if argv else 2
    if argv[0] == "--version":
        print(f"patina {__version__}")
        return 0
    name = argv[0]
    if name not in COMMANDS:
        _check_arguments(argv)
        found = usageHints.nearest(name, COMMANDS)
        raise UsageError(f"patina: there is no command '{name}'" + (f"; did you mean {found}?" if found else "") +
                         f" (there are: {', '.join(COMMANDS)})")
    module = module_of(name)
    if not getattr(module, "NAMES_OF_ANY_BYTES", False):
        _check_arguments(argv)
    parser = _Parser(prog=f"patina {name}", description=module.__doc__)
    module.add_arguments(parser)
    if getattr(module, "PASSES_ON", False):
        words = argv[1:] if getattr(module, "AS_TYPED", False) else _normalise(argv[1:])
        arguments, arguments_left = parser.parse_known_args(words)
        arguments.passed_on = arguments_left
    else:
        words = parser.words = _normalise(argv[1:])
        # A file that may be left out is found wherever it stands among the flags.
        parse = parser.parse_intermixed_args if getattr(module, "INTERMIXED", False) else parser.parse_args
        arguments = parse(words)
        arguments.argv, arguments.given = list(argv), _given(parser, parse, words)
    limits.apply(getattr(arguments, "limit", []))
    try:
        return module.run(arguments) or 0
    finally:
        limits.apply([])


def _given(parser, parse, words):
    """:returns: names of the arguments that were typed, not taken from defaults"""
    blank = argparse.Namespace(**{a.dest: [] if isinstance(a.default, list) else None for a in parser._actions})
    return {name for name, value in vars(parse(words, blank)).items() if value not in (None, [])}


def _text_of(error):
    # Errors of pxr name the place in its code; what they say of the matter is the commentary.
    texts = [str(item.commentary) for item in error.args if hasattr(item, "commentary")]
    return " ".join((" ".join(texts) or str(error)).split())


def _one_line(error):
    try:
        text = _text_of(error)
    except UnicodeDecodeError as inner:  # the error quotes what it read
        error = inner
    if isinstance(error, UnicodeDecodeError):
        return f"what was read holds a text that is not UTF-8: {bytes(error.object)[:200]!r}"
    if isinstance(error, MemoryError):
        text = "out of memory"
    elif isinstance(error, ModuleNotFoundError) and (error.name or "").partition(".")[0] in ("pxr", "numpy"):
        text = f"Python's {error.name} is missing: pip install usd-core numpy (or PATINA_PYTHON names a Python that has them)"
    elif not isinstance(error, (UsageError, CommandError, RuntimeError, OSError)):
        text = f"{type(error).__name__}: {text}" if text else type(error).__name__
    return causes.printable(text or type(error).__name__)


def main(argv=None):
    """:returns: the exit status"""
    with standardStreams.Streams(), interrupts.Endings() as endings:
        try:
            try:
                endings.check()  # what came while this was imported
                inputs.forget()
                status = _dispatch(sys.argv[1:] if argv is None else argv)
                sys.stdout.flush()
                return status
            finally:
                endings.settle()
        except BrokenPipeError:  # `patina ... | head`
            standardStreams.silence(sys.stdout)
            return 1
        except (Exception, KeyboardInterrupt) as error:
            return _failed(error, endings, (sys.argv[1:] if argv is None else argv)[:1])


def _failed(error, endings, command):
    """:returns: the exit status, after the reason in one line"""
    if os.environ.get("PATINA_TRACEBACK"):
        traceback.print_exc()
    ended = isinstance(error, KeyboardInterrupt) or endings.met and (
        not isinstance(error, CommandError) or isinstance(error.__cause__, ImportError))
    if isinstance(error, UsageError) and not ended:
        print(colours.painted(_one_line(error), sys.stderr), file=sys.stderr)
        return USAGE
    reason = f"patina: {endings.text() if ended else _one_line(error)}"
    print(colours.painted(reason, sys.stderr), file=sys.stderr)
    return TEMPORARY if is_temporary(error) or (ended and command and command[0] in _BATCH) else FAILED
