# SPDX-License-Identifier: Apache-2.0
"""Charts of what methods and renderers cost, against how far they are off."""
