# SPDX-License-Identifier: Apache-2.0
"""A sweep: one parameter through the region where a method fails, with what the methods give, the truth, and the bound
that the method keeps which is used there.
"""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Sweep:
    """name: of the sweep, and of its files
    family: what it belongs to (Fresnel, facets, ...)
    fails: one sentence: which method fails where, and how
    x_label, x: the parameter; log_x: on a logarithmic axis
    y_label: of what is drawn; log_y: on a logarithmic axis
    curves: method -> values over x
    truth: values over x, or one value
    chosen: the method that holds, that of the planner or the default: per x, or one
    bound: largest |chosen - truth| that is promised, absolute
    failing: the method that fails; shows: by how much its error is above the bound somewhere, as a factor
    switch: x where `chosen` changes, if it does
    """
    name: str
    family: str
    fails: str
    x_label: str
    x: list
    y_label: str
    curves: dict
    truth: list
    chosen: list
    bound: float
    failing: str
    switch: float = None
    log_x: bool = False
    log_y: bool = False
    shows: float = 1.0
    notes: list = field(default_factory=list)

    def __post_init__(self):
        if np.ndim(self.truth) == 0:
            self.truth = [self.truth] * len(self.x)
        if np.ndim(self.chosen) == 0:
            self.chosen = [self.chosen] * len(self.x)

    def error(self, method):
        """:returns: |method - truth| over x"""
        return np.abs(np.asarray(self.curves[method], float) - np.asarray(self.truth, float))

    def held(self):
        """:returns: the error of the chosen method over x"""
        errors = {m: self.error(m) for m in set(self.chosen)}
        return np.array([errors[m][i] for i, m in enumerate(self.chosen)])

    def problems(self):
        """:returns: list of what is not as it should be: the bound that does not hold, the failure that does not show"""
        found = []
        held = self.held()
        for method, values in self.curves.items():
            if not np.isfinite(np.asarray(values, float)).all() and method in self.chosen:
                found.append(f"{self.name}: {method} is not finite")
        if not (held <= self.bound).all():
            i = int(np.argmax(np.where(np.isfinite(held), held, np.inf)))
            found.append(f"{self.name}: {self.chosen[i]} is off by {held[i]:.3g} at {self.x_label} {self.x[i]:g}, "
                         f"bound {self.bound:g}")
        worst = self.error(self.failing)
        worst = np.where(np.isfinite(worst), worst, np.inf).max()
        if not worst > self.shows * self.bound:
            found.append(f"{self.name}: {self.failing} does not fail: its largest error is {worst:.3g}, "
                         f"bound {self.bound:g}")
        return found

    def rows(self):
        """:returns: rows of the CSV file"""
        for i, x in enumerate(self.x):
            for method, values in self.curves.items():
                yield {"sweep": self.name, "x": x, "method": method, "value": float(values[i]),
                       "truth": float(self.truth[i]), "error": float(self.error(method)[i]), "bound": self.bound,
                       "chosen": int(method == self.chosen[i])}
