"""Who else is there: nodes that publish what commands a motor, or a plant's samples.

publishers     who publishes a topic, by name and by what the middleware knows them by
acquaintances  whom one knows well enough to obey, and who only plays a recording
players        nodes that play recordings
commanders     looks for them on a node's topics
callers        answers requests once it is known who may have asked
open_sockets   the middleware listens to every network, unasked
other_plant    somebody else publishes a plant's samples
"""
