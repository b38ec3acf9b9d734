"""Changes MCAP files by their grammar: records, fields, chunks; checksums are made right again, so readers go on."""

import struct
import zlib
from random import Random

import lz4.frame
import zstandard

MAGIC = b"\x89MCAP0\r\n"
CHUNK, DATA_END = 6, 15
MOST = 50_000  # records that are told apart: a bomb that was opened has millions
Records = list[tuple[int, bytes]]
INTEGERS = (0, 1, 2, 127, 255, 2**15, 2**16 - 1, 2**31 - 1, 2**31, 2**32 - 1, 2**53, 2**62, 2**63 - 1, 2**63, 2**64 - 1)
TEXTS = (
    b"venv/__main__/X", b"evil/msg/X", b"../../etc/passwd", b"\x1b[2J", b"\xff\xfe", b"$\\frac{", b"<script>",
    b"a" * 5000, b"string[300000] x\n", b"float64 x\nimport os\n", b"__import__('os').system('touch ran')", b"", b"\0",
    b"%s%n",    b"std_msgs/msg/Float64", b"motor_msgs/msg/MotorInfo", b"/motor/speed", b"/motor/info",
    b"a: &a [*a]", b"[" * 3000,
)  # fmt: skip


def split(data: bytes) -> Records:
    """The records of a file or of a chunk."""
    position = len(MAGIC) if data.startswith(MAGIC) else 0
    found: Records = []
    while position + 9 <= len(data) and len(found) < MOST and not data.startswith(MAGIC, position):
        opcode, length = struct.unpack_from("<BQ", data, position)
        found.append((opcode, data[position + 9 : position + 9 + length]))
        position += 9 + length
    return found


def join(records: Records) -> bytes:
    """The bytes of records."""
    return b"".join(struct.pack("<BQ", opcode, len(content)) + content for opcode, content in records)


def opened(content: bytes) -> bytes:
    """What a chunk's record holds."""
    (length,) = struct.unpack_from("<I", content, 28)
    kind = content[32 : 32 + length]
    data = content[32 + length + 8 :]
    return {b"zstd": zstandard.decompress, b"lz4": lz4.frame.decompress}.get(kind, bytes)(data)


def closed(data: bytes, random: Random, size: int | None = None) -> bytes:
    """A chunk's record around records, packed in one of the ways."""
    kind, pack = random.choice(((b"zstd", zstandard.compress), (b"lz4", lz4.frame.compress), (b"", bytes)))
    packed = pack(data)
    crc = random.choice((0, zlib.crc32(data)))
    head = struct.pack("<QQQII", 1, 2, len(data) if size is None else size, crc, len(kind))
    return head + kind + struct.pack("<Q", len(packed)) + packed


def bombed(random: Random) -> bytes:
    """A chunk that stands for gigabytes."""
    kind, pack = random.choice(((b"zstd", zstandard.compress), (b"lz4", lz4.frame.compress)))
    size = 1 << random.choice((24, 27, 28))
    packed = pack(bytes(size)) if size < 1 << 28 else pack(b"\x05" + struct.pack("<Q", 30) + bytes(1 << 26))
    return (
        struct.pack("<QQQII", 1, 2, random.choice((size, 100)), 0, len(kind))
        + kind
        + (struct.pack("<Q", len(packed)) + packed)
    )


def changed_bytes(data: bytes, random: Random) -> bytes:
    """A few bytes flipped, numbers put in, a piece cut out or doubled."""
    out = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 8, 50))):
        if not out:
            break
        at = random.randrange(len(out))
        way = random.randrange(5)
        if way == 0:
            out[at] ^= 1 << random.randrange(8)
        elif way == 1:
            size = random.choice((1, 2, 4, 8))
            out[at : at + size] = (random.choice(INTEGERS) % (1 << 8 * size)).to_bytes(size, "little")
        elif way == 2:
            del out[at : at + random.choice((1, 4, 100))]
        elif way == 3:
            out[at:at] = out[at : at + random.choice((1, 8, 500))]
        else:
            out[at:at] = random.choice(TEXTS)
    return bytes(out)


def changed_records(records: Records, random: Random, deep: bool = True) -> Records:
    """A few records changed, doubled, lost, swapped; some of their chunks opened and changed inside."""
    out = list(records)
    for _ in range(random.choice((1, 1, 2, 5))):
        if not out:
            break
        at = random.randrange(len(out))
        opcode, content = out[at]
        way = random.randrange(6)
        if opcode == CHUNK and deep and way < 4:
            inner = changed_records(split(opened(content)), random, deep=False)
            out[at] = (CHUNK, closed(join(inner), random))
        elif way == 0:
            out[at] = (random.randrange(256), content)
        elif way == 1:
            out[at] = (opcode, changed_bytes(content, random))
        elif way == 2:
            out[at:at] = [out[at]] * random.choice((1, 2, 300))
        elif way == 3:
            del out[at]
        elif way == 4:
            other = random.randrange(len(out))
            out[at], out[other] = out[other], out[at]
        else:
            out[at:at] = [(CHUNK, bombed(random) if random.random() < 0.1 else closed(join(out[at : at + 2]), random))]
    return out


def mutated(data: bytes, random: Random) -> bytes:
    """A file that somebody changed."""
    way = random.randrange(10)
    if way == 0:
        return data[: random.randrange(len(data) + 1)]
    if way <= 3:
        return changed_bytes(data, random)
    return MAGIC + join(changed_records(split(data), random)) + random.choice((MAGIC, b"", MAGIC[:3]))
