# SPDX-License-Identifier: Apache-2.0
"""The reflectance curves that shaders/bake/albedoFit.py is fitted to, as functions of the cosine."""
import numpy as np

DIELECTRICS = (1.03, 1.05, 1.08, 1.12, 1.2, 1.3, 1.5, 1.7, 2.0, 2.5, 3.0)
CONDUCTORS = ((0.2, 3.9), (0.18, 3.4), (1.5, 7.0), (2.9, 3.1), (0.05, 2.1), (3.2, 3.3))  # n, k
EXPONENTS = (8.0, 5.0, 3.5, 2.5, 2.0, 1.5, 1.0)  # of Schlick's curve


def dielectric(c, eta):
    """Exact, unpolarised, from outside (eta >= 1)."""
    g = np.sqrt(eta * eta - 1.0 + c * c)
    s = (c - g) / (c + g)
    p = (eta * eta * c - g) / (eta * eta * c + g)
    return 0.5 * (s * s + p * p)


def conductor(c, n, k):
    """Exact, unpolarised (Born and Wolf 1999, section 14.2)."""
    m2 = (n + 1j * k) ** 2
    g = np.sqrt(m2 - 1.0 + c * c)
    s = (c - g) / (c + g)
    p = (m2 * c - g) / (m2 * c + g)
    return 0.5 * (np.abs(s) ** 2 + np.abs(p) ** 2)


def curves():
    """:returns: list of (name, function of an array of cosines in (0, 1])"""
    found = [(f"ior {eta:g}", lambda c, eta=eta: dielectric(c, eta)) for eta in DIELECTRICS]
    found += [(f"n {n:g} k {k:g}", lambda c, n=n, k=k: conductor(c, n, k)) for n, k in CONDUCTORS]
    found += [(f"(1 - c)^{e:g}", lambda c, e=e: (1.0 - c) ** e) for e in EXPONENTS]
    found += [("white", np.ones_like), ("dip at 82 degrees", lambda c: 3.0 * c * (1.0 - c) ** 6)]
    return found
