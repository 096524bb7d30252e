# SPDX-License-Identifier: Apache-2.0
"""Chances of statistical tests, for checks, golden images and the tests of a checkout."""
import math


def sidak(significance, tests):
    """:returns: what each of some independent tests may reject by chance, for so much by all of them"""
    return 1.0 - (1.0 - significance) ** (1.0 / tests)


def chi_squared_tail(statistic, freedom):
    """:param freedom: a whole number
    :returns: upper tail of the distribution (Abramowitz and Stegun 1964, 26.4.4 and 26.4.5)"""
    half = 0.5 * statistic
    if half <= 0.0:
        return 1.0
    steps = (i + 0.5 * (freedom % 2) for i in range(freedom // 2))
    first = math.erfc(math.sqrt(half)) if freedom % 2 else 0.0
    return min(1.0, first + math.fsum(math.exp(i * math.log(half) - half - math.lgamma(i + 1.0)) for i in steps))
