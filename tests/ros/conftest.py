"""A bench, and processes that end with the test."""

from ros_fixtures import bench, start  # noqa: F401  (fixtures)
