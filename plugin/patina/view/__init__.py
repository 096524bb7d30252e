# SPDX-License-Identifier: Apache-2.0
"""The material page: any material in a browser, with sliders."""
