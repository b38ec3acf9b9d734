"""What commands share: options and help in, an exit status and one sentence out; Ctrl-C is no traceback.

parser        the command line: usage, help, --version, completion by TAB
number_types  numbers on it, within their ranges
shell         how a command's work ends: exit status, sentence, interrupt
"""
