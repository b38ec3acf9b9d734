"""`ros2 pkg`: which packages and executables there are."""

import argparse

from ros2_stand_in.interfaces import packages as installed


def packages_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 pkg list` takes: nothing."""


def packages(args: argparse.Namespace) -> int:
    """Print all packages."""
    for name in installed.package_names():
        print(name)
    return 0


def executables_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 pkg executables` takes."""
    parser.add_argument("package_name", nargs="?", help="name of the package; all packages without one")
    parser.add_argument("--full-path", action="store_true", help="print the paths")


def executables(args: argparse.Namespace) -> int:
    """Print the executables of a package, or of all."""
    for package in [args.package_name] if args.package_name else installed.package_names():
        for path in installed.executables(package):
            print(path if args.full_path else f"{package} {path.name}")
    return 0
