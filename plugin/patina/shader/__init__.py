# SPDX-License-Identifier: Apache-2.0
"""Writes a material as shader text for others: GLSL, MaterialX documents, and what MaterialX's own generators make of them."""
