# SPDX-License-Identifier: Apache-2.0
"""Frames over many machines: parts of cut frames, what made them, and the engines that spread them."""
