# SPDX-License-Identifier: Apache-2.0
"""The material library: documents of materialNetwork/library, their pictures, and the page that shows them."""
