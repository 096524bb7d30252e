# SPDX-License-Identifier: Apache-2.0
"""Prints the matrix of shaders/lib/conductorAlbedo.glsl.

A conductor's reflectance is written as a sum of (1 - c)^p over six exponents of the moment table,
exact at six cosines. Row p, column j: how much of the reflectance at cosine j goes into exponent p.
"""

EXPONENTS = (0.0, 1.7, 2.5, 5.0, 10.0, 20.0)
COSINES = tuple((j / 5.0) ** 1.5 for j in range(6))


def inverse(rows):
    """Gauss-Jordan with pivoting; small and dense, so no library is needed."""
    n = len(rows)
    work = [list(row) + [float(i == k) for k in range(n)] for i, row in enumerate(rows)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(work[r][i]))
        work[i], work[pivot] = work[pivot], work[i]
        work[i] = [value / work[i][i] for value in work[i]]
        for r in range(n):
            if r != i:
                work[r] = [a - work[r][i] * b for a, b in zip(work[r], work[i])]
    return [row[n:] for row in work]


if __name__ == "__main__":
    basis = [[1.0 if p == 0.0 else (1.0 - c) ** p for p in EXPONENTS] for c in COSINES]
    print("cosines", ", ".join(f"{c:.9g}f" for c in COSINES))
    for p, row in zip(EXPONENTS, inverse(basis)):
        print(f"{p:g}:", ", ".join(f"{value:.9g}f" for value in row))
