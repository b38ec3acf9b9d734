"""A bench, and processes that end with the test."""

from controller_bench import plant, process  # noqa: F401  (fixtures)
from ros_fixtures import bench, start  # noqa: F401  (fixtures)
