"""What this `ros2` can do, as a table; a new verb is a new row and a function."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Verb:
    """One verb: the words that call it, where its function is, and what `--help` says.

    The module of `verbs/` that `place` names has the function, which takes the parsed arguments and returns the exit
    status, and `<function>_arguments`, which takes the parser to fill.
    """

    words: str
    place: str
    help: str


VERBS = (
    Verb("run", "run:run", "Run an executable of a package."),
    Verb("pkg executables", "pkg:executables", "List the executables of a package, or of all."),
    Verb("pkg list", "pkg:packages", "List the packages that are on the path."),
    Verb("topic list", "topic:topics", "List the topics."),
    Verb("topic info", "topic:info", "Say who publishes and who subscribes to a topic."),
    Verb("topic type", "topic:type_of", "Print the type of a topic."),
    Verb("topic echo", "topic_echo:echo", "Print the messages of a topic."),
    Verb("topic hz", "topic_hz:rate", "Print how often messages come on a topic."),
    Verb("topic pub", "topic_pub:publish", "Publish messages to a topic."),
    Verb("service list", "service:services", "List the services."),
    Verb("service type", "service:type_of", "Print the type of a service."),
    Verb("service call", "service:call", "Call a service and print its answer."),
    Verb("action list", "action:actions", "List the actions."),
    Verb("action send_goal", "action:send_goal", "Send a goal to an action and print its result; Ctrl-C cancels it."),
    Verb("interface show", "interface:show", "Print the definition of a message, service or action type."),
    Verb("interface list", "interface:interfaces", "List all interface types."),
    Verb("node list", "node:nodes", "List the running nodes."),
    Verb("node info", "node:info", "Print the topics, services and actions of a node."),
    Verb("param list", "param:names", "List the parameters of a node, or of all."),
    Verb("param get", "param:get", "Print the value of a parameter."),
    Verb("param set", "param:assign", "Set a parameter."),
    Verb("param describe", "param:describe", "Print what a parameter means, its type and its range."),
    Verb("param dump", "param:dump", "Print all parameters of a node as YAML."),
    Verb("bag record", "bag:record", "Record topics to a bag."),
    Verb("bag play", "bag:play", "Publish what a bag recorded."),
    Verb("bag info", "bag:info", "Print what is in a bag."),
    Verb("bag reindex", "bag:reindex", "Write the metadata.yaml that a crash left unwritten."),
)
