"""Who else is there: nodes that publish what commands a motor, or a plant's samples.

publishers     who publishes a topic, by name and by what the middleware knows them by
acquaintances  whom one knows well enough to obey, and who only plays a recording
players        nodes that play recordings, and what they may call
commanders     looks for them on a node's topics
other_plant    somebody else publishes a plant's samples
"""
