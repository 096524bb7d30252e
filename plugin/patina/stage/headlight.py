# SPDX-License-Identifier: Apache-2.0
"""Light for stages that have none."""
import numpy as np

DISTANT, DOME = "/patinaHeadlight/distant", "/patinaHeadlight/dome"


def emit(context, camera_transform):
    """A distant light from the camera and a faint white dome that the camera does not see. A diffuse
    surface that faces the camera shows its own albedo: 0.75 of the light is the distant light's (its
    irradiance is pi times that), 0.25 the dome's."""
    context.edit.set_light(DISTANT, type="distant", transform=camera_transform, normalize=True, angle=5.0,
                           intensity=float(0.75 * np.pi))
    context.edit.set_light(DOME, type="dome", intensity=0.25, camera_visible=False)
    context.notes.append("the stage has no lights; it is lit by a headlight and a faint dome")
