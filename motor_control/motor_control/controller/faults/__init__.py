"""Detect faults that stop the motor for good: edges and voltage cannot belong to one motor that runs as it should.

In goes what a sample shows (`evidence`), out comes a sentence, or none (`detection` asks all of them):

    stall            full voltage, and fewer edges than can be told from a standstill for `stall_time`
    few_edges        the motor turns slower than 30 % of what the model predicts, or of what it last did under less
                     voltage, while the voltage rises: a line that is lost (whether or not noise still counts), a shaft
                     that is held
    irregular_edges  periods that jump back and forth: noise, no motor
    unexpected_edges edges at angles where the model's motor is not: noise that is too slow for its periods to be judged
    direction/       motions that the voltage does not drive: a wrong sign, a bridge that stays on, a load
    push_at_rest     voltages that no load needs where the motor shall stand
    insensitive_speed  a speed that no voltage changes: hum on the line
    hum              edges in the rhythm of the mains, or that have jumped to another one, under 0 V or beside more
                     voltage than they need
    dropouts         edges that stop and go on as if nothing had been: a loose contact
    contradiction    a reported speed that is not the one of its own edges: a driver that repeats itself, other counts
    repetition       one sample again and again, whatever voltage is asked for: a driver that hangs
    overspeed        faster than full voltage can drive the motor of the model: edges that are none, or a load

The speed is the one the law uses, or counted edges (`controller.motion`); the voltage is the one the plant says it
applies; times are the plant's. All bounds are shares of the motor's own top speed, slot rate and voltage.
"""
