"""Gives all tests of the Python module access to the module and the repository's files."""

import os
import sys
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "benchmarks" / "python"))

import hairbench  # noqa: E402, F401  # for the tests, from the repository
from hairbench.program import call  # noqa: E402


def need_device(test: unittest.TestCase) -> None:
    """Skips the test without a Vulkan device, or fails it if HAIRBENCH_REQUIRE asks for one."""
    if call(["devices"], None).status == 0:
        return
    if "device" in os.environ.get("HAIRBENCH_REQUIRE", "").split(","):
        test.fail("there is no Vulkan device; HAIRBENCH_REQUIRE asks for one")
    test.skipTest("there is no Vulkan device")
