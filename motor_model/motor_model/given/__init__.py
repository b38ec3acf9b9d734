"""What a node is given in parameter files and words, and what of it does not reach the node.

ROS 2 passes over a parameter that a node does not have, and over a section of a file whose name is none of the node's,
in silence: `max_voltge: 3` is 12 V. In go the names, out comes what was probably meant, as a clause.
"""
