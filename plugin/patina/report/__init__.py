# SPDX-License-Identifier: Apache-2.0
"""The page that `patina record --report` writes about one render."""
