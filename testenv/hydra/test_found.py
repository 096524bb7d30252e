# SPDX-License-Identifier: Apache-2.0
"""Says in one line when the Hydra tests are left out, and asks the plugin whether it can be used."""
import os
import subprocess

import pytest

import hydraBuild


def test_the_plugin_can_be_used():
    reason = hydraBuild.missing()
    if reason:
        pytest.skip(reason)
    program = os.path.join(os.environ["PATINA_BUILD_DIR"], "plugin", "hydra", "patinaHydraInfo")
    process = subprocess.run([program], env=hydraBuild.environment(), capture_output=True, text=True, check=False)
    assert process.returncode == 0, process.stdout + process.stderr
    assert "Patina" in process.stdout
