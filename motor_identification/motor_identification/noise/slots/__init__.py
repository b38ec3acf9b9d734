"""Estimate the offset of every slot of an irregular disc, from angle increments that are whitened as it goes."""
