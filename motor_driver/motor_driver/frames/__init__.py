"""The frames that driver and board exchange, as values; `protocol.py` turns them into bytes and back.

The normative table, with the rules of who may say what when, is motor_board/protocol/wire.yaml; tests hold these files
against it. Units: times and periods in board ticks (`Hello.tick_ns`), duty in 1/`Hello.pwm_top` of full voltage.
"""
