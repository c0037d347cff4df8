"""Reads the arrays of a surface file of abrade, by itself: it shares no code with what it checks."""

import re
import struct
import zlib


def arrays(path):
    """Point arrays by name: numbers, or triples of them."""
    data = path.read_bytes()
    head, raw = data.split(b'<AppendedData encoding="raw">\n_', 1)
    found = {}
    for tag in re.findall(rb"<DataArray [^>]*>", head):
        get = lambda key: re.search(key + rb'="([^"]*)"', tag).group(1).decode()
        if get(rb"type") != "Float64":
            continue
        at = int(get(rb"offset"))
        count, _, _ = struct.unpack_from("<3Q", raw, at)
        sizes = struct.unpack_from(f"<{count}Q", raw, at + 24)
        at, plain = at + 24 + 8 * count, b""
        for size in sizes:
            plain += zlib.decompress(raw[at:at + size])
            at += size
        numbers = struct.unpack(f"<{len(plain) // 8}d", plain)
        width = int(get(rb"NumberOfComponents"))
        found[get(rb"Name")] = numbers if width == 1 else list(zip(*[iter(numbers)] * width))
    return found
