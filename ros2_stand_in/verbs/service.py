"""`ros2 service`: which services there are, and calling one."""

import argparse

from motor_model.errors import MotorError
from ros2_stand_in.graph import discovery
from ros2_stand_in.graph.session import session
from ros2_stand_in.interfaces import interface_type, values

_LONGEST_WAIT = 10.0  # [s] for a service that nobody offers (yet)
_LOOK_EVERY = 0.02  # [s]


def services_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 service list` takes."""
    parser.add_argument("-t", "--show-types", action="store_true", help="print the types too")
    parser.add_argument("-c", "--count-services", action="store_true", help="print only how many there are")
    parser.add_argument("--include-hidden-services", action="store_true", help="services whose name starts with _ too")
    discovery.discovery_arguments(parser)


def services(args: argparse.Namespace) -> int:
    """Print all services."""
    with session() as ros:
        discovery.settle(ros, args.spin_time)
        rows = discovery.visible(ros.node.get_service_names_and_types(), args.include_hidden_services)
        discovery.print_list(rows, args.show_types, args.count_services)
    return 0


def type_of_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 service type` takes."""
    parser.add_argument("service_name", help="name of the service")
    discovery.discovery_arguments(parser)


def type_of(args: argparse.Namespace) -> int:
    """Print the type of a service."""
    name = discovery.full_name(args.service_name)
    with session() as ros:

        def types() -> list[str]:
            there: dict[str, list[str]] = dict(ros.node.get_service_names_and_types())
            return there.get(name, [])

        discovery.settle(ros, args.spin_time, types)
        if not types():
            raise MotorError(f"Unknown service '{name}': no running node offers it.")
        print(*types(), sep="\n")
    return 0


def call_arguments(parser: argparse.ArgumentParser) -> None:
    """What `ros2 service call` takes."""
    parser.add_argument("service_name", help="name of the service")
    parser.add_argument("service_type", help="type, such as std_srvs/srv/SetBool")
    parser.add_argument("values", nargs="?", default="{}", help="fields of the request in YAML, such as '{data: true}'")


def call(args: argparse.Namespace) -> int:
    """Call a service, however long its answer takes, and print the answer."""
    kind = interface_type.load(args.service_type, "srv")
    request = kind.Request()
    values.fill(request, values.parse(args.values))
    name = discovery.full_name(args.service_name)
    with session() as ros:
        client = ros.node.create_client(kind, name)
        if not client.service_is_ready():
            print("waiting for service to become available...")
        if not ros.spin(client.service_is_ready, _LONGEST_WAIT, _LOOK_EVERY):
            raise MotorError(f"No service '{name}' of type {args.service_type} came up: is its node running?")
        print(f"requester: making request: {request!r}\n")
        answer = client.call_async(request)
        ros.spin(lambda: answer.done() or not client.service_is_ready())
        if not answer.done():
            raise MotorError(f"The node that offers '{name}' ended before it answered.")
        print(f"response:\n{answer.result()!r}\n")
    return 0
