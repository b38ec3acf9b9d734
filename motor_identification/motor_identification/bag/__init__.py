"""The only place that knows bags: reads any, cut off or not, and writes rosbag2 directories with MCAP storage."""

from motor_identification.bag.contents import Contents
from motor_identification.bag.motor.recording import read_recording
from motor_identification.bag.new_bag import check_new_bag
from motor_identification.bag.reader import contents, in_time_order, messages, topics
from motor_identification.bag.repair import repair
from motor_identification.bag.source import Source, Window
from motor_identification.bag.topic import Qos, Topic, absolute_name, named_topic
from motor_identification.bag.writer import FLUSH_EVERY, BagWriter

__all__ = [
    "FLUSH_EVERY",
    "BagWriter",
    "Contents",
    "Qos",
    "Source",
    "Topic",
    "Window",
    "absolute_name",
    "check_new_bag",
    "contents",
    "in_time_order",
    "messages",
    "named_topic",
    "read_recording",
    "repair",
    "topics",
]
