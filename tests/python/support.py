"""Gives all tests of the Python module access to the module and the repository's files."""

import os
import sys
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "benchmarks" / "python"))

import hairbench  # noqa: E402, F401  # for the tests, from the repository
from hairbench.program import call  # noqa: E402


def skip_without(test: unittest.TestCase, need: str, reason: str) -> None:
    """Skips the test, or fails it if HAIRBENCH_REQUIRE asks for what it needs."""
    if need in os.environ.get("HAIRBENCH_REQUIRE", "").split(","):
        test.fail(f"{reason}; HAIRBENCH_REQUIRE asks for {need}")
    test.skipTest(reason)


def need_device(test: unittest.TestCase) -> None:
    if call(["devices"], None).status != 0:
        skip_without(test, "device", "there is no Vulkan device")
