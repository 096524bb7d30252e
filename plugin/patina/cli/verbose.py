# SPDX-License-Identifier: Apache-2.0
"""What `patina record` says of a frame that is done: one line, or with --verbose time and memory of each phase."""
from patina.cli import memory

# phase of the statistics -> what it is called; in their order
NAMES = {"open": "read", "translate": "translate", "build": "build", "render": "sample", "denoise": "denoise", "write": "write",
         "report": "report"}


def lines(frame):
    """:param frame: of the statistics, after its end
    :returns: lines of a table; memory is what the process had at the end of the phase"""
    head = frame["images"][0] + ("" if frame["frame"] is None else f", frame {frame['frame']:g}")
    made = [head, f"  {'phase':<11}{'seconds':>9}{'memory':>10}"]
    for name, word in NAMES.items():
        seconds = frame["seconds"].get(name)
        if seconds is not None:
            made.append(f"  {word:<11}{seconds:>9.2f}{memory.text(frame['memory'].get(name)):>10}{_more(name, frame)}")
    made.append(f"  {'all':<11}{sum(frame['seconds'].values()):>9.2f}{memory.text(memory.peak()):>10}  the peak so far")
    return made


def line(frame, file=None):
    """:param frame: of the statistics, after its end
    :param file: that is written in place of its images
    :returns: what stands on the terminal when they are written"""
    samples = f"{frame['samplesPerPixel']:.4g} sample" + "s" * (frame["samplesPerPixel"] != 1.0)
    text = f"{file or ', '.join(frame['images'])}: {samples} in {sum(frame['seconds'].values()):.3g} s"
    if "estimatedError" in frame:
        text += f", noise {100.0 * frame['estimatedError']:.2g} %{_denoised(frame)}"
        scene = frame.get("plan", {}).get("scene", {}).values()
        bias = frame.get("predictedError", 0.0) + sum(choice["error"] for choice in scene)
        if bias:
            text += f", methods, edges and paths up to {100.0 * bias:.2g} % more by their measured errors"
    return text


def _denoised(frame):
    return f", denoised {100.0 * frame['denoisedError']:.2g} % at most" if "denoisedError" in frame else ""


def _more(name, frame):
    if name == "render":
        seconds, rays = frame["seconds"]["render"], frame.get("rays", 0)
        speed = f", {rays / seconds / 1e6:.3g} million rays per second" if rays and seconds > 0.0 else ""
        error = f", noise {100.0 * frame['estimatedError']:.2g} %{_denoised(frame)}" if "estimatedError" in frame else ""
        return f"  {frame['samplesPerPixel']:.4g} samples per pixel of {frame['width']} x {frame['height']}{error}{speed}"
    if name == "build" and "bytes" in frame:
        return f"  {frame.get('trianglesStored', 0)} triangles, {memory.text(frame['bytes'])} of geometry"
    return ""
