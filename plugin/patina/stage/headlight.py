# SPDX-License-Identifier: Apache-2.0
"""Light for stages that have none."""
import numpy as np

EYE, DOME = "/patinaHeadlight/eye", "/patinaHeadlight/dome"
_STEP = 1.2  # between knots; a line from knot to knot lies up to (_STEP - 1)**2 / 4 above the square
_MOST = 128  # steps


def emit(context, camera):
    """A light at the camera's eye that is as bright from all distances, as usdview's camera light is, and a faint white dome
    that the camera does not see. A diffuse surface that faces the eye shows its own albedo: 0.75 of the light is the
    headlight's (its irradiance is pi times that), 0.25 the dome's. Parallel rays come from no eye: there the light is parallel
    as well, and throws no shadows, since what lies behind the camera would hide it.

    :param camera: cameras.Placed"""
    if camera.orthographic:
        context.edit.set_light(EYE, type="distant", transform=camera.transform, normalize=True, angle=5.0,
                               intensity=float(0.75 * np.pi), shadow_enable=False)
    else:
        # A point's intensity is a quarter of the normalized radiance; it falls with the square, which the ramp takes back.
        far = camera.clip_far if 1e-12 < camera.clip_far < 1e12 else 1e6
        near = camera.clip_near if far * _STEP ** -_MOST < camera.clip_near < far / _STEP else far * 1e-6
        knots = np.geomspace(near / far, 1.0, int(np.log(far / near) / np.log(_STEP)) + 2)
        fall = {"path": EYE + "/noFalloff", "type": "ramp", "endDistance": far, "rampKnots": knots.astype(np.float32),
                "rampFloats": (knots ** 2 * far / near).astype(np.float32)}  # 1 in the middle of the range
        context.edit.set_light(EYE, type="sphere", transform=_places(camera.transform), treat_as_point=True, normalize=True,
                               radius=0.0, intensity=float(3.0 * np.pi * near * far), filters=[fall])
    context.edit.set_light(DOME, type="dome", intensity=0.25, camera_visible=False)
    context.notes.append("the stage has no lights; it is lit by a headlight and a faint dome")


def _places(transform):
    """:param transform: a matrix, or (times, matrices)
    :returns: the same without turns and scales"""
    if isinstance(transform, tuple):
        return transform[0], [_places(matrix) for matrix in transform[1]]
    place = np.eye(4)
    place[3, :3] = np.asarray(transform)[3, :3]
    return place
