#!/usr/bin/env python3
"""Writes examples/library/capitals.ttf, the small font of the examples of hfText: eight capitals of our own.

usage: tools/example_font.py FILE

TrueType outlines (outer contours clockwise, quadratic curves), tables as the OpenType specification has them;
no names, no dates, no hinting, so that the bytes are always the same. CC0-1.0.
"""
import struct
import sys

EM, HEIGHT, STEM = 1000, 700, 140


def box(x0, y0, x1, y1):
    """A clockwise rectangle."""
    return [(x0, y0, 1), (x0, y1, 1), (x1, y1, 1), (x1, y0, 1)]


def round_right(x0, y0, x1, y1, clockwise=True):
    """Straight on the left, a half of a superellipse of two quadratics on the right."""
    middle = (y0 + y1) // 2
    bend = x1 - (y1 - y0) // 2
    points = [(x0, y0, 1), (x0, y1, 1), (bend, y1, 1), (x1, y1, 0), (x1, middle, 1), (x1, y0, 0), (bend, y0, 1)]
    return points if clockwise else points[::-1]


def ring(x0, y0, x1, y1, clockwise=True):
    """Four quadratics."""
    mx, my = (x0 + x1) // 2, (y0 + y1) // 2
    points = [(x0, my, 1), (x0, y1, 0), (mx, y1, 1), (x1, y1, 0), (x1, my, 1), (x1, y0, 0), (mx, y0, 1), (x0, y0, 0)]
    return points if clockwise else points[::-1]


def comb(width, bars):
    """A stem on the left with bars (low, high, right end), from the top down: one clockwise contour."""
    points = [(0, 0, 1), (0, HEIGHT, 1)]
    for low, high, right in bars:
        points += [(STEM, high, 1)] if points[-1][1] != high else []
        points += [(right, high, 1), (right, low, 1), (STEM, low, 1)]
    if points[-1][1] != 0:
        points.append((STEM, 0, 1))
    else:
        points.pop()  # the lowest bar ends in the stem's corner
    return points


GLYPHS = {  # contours, advance width
    'B': ([round_right(0, 330, 500, HEIGHT), round_right(0, 0, 540, 370),
           round_right(STEM, 460, 380, 580, False), round_right(STEM, 130, 410, 250, False)], 620),
    'E': ([comb(460, [(560, 700, 460), (280, 420, 420), (0, 140, 460)])], 540),
    'F': ([comb(460, [(560, 700, 460), (280, 420, 420)])], 520),
    'H': ([box(0, 0, STEM, HEIGHT), box(STEM, 280, 400, 420), box(400, 0, 540, HEIGHT)], 640),
    'O': ([ring(0, 0, 660, HEIGHT), ring(STEM, STEM, 520, 560, False)], 740),
    'P': ([round_right(0, 280, 500, HEIGHT), box(0, 0, STEM, 300), round_right(STEM, 410, 370, 570, False)], 580),
    'R': ([round_right(0, 280, 500, HEIGHT), box(0, 0, STEM, 300), round_right(STEM, 410, 370, 570, False),
           [(180, 300, 1), (330, 300, 1), (540, 0, 1), (380, 0, 1)]], 610),
    'T': ([box(0, 560, 540, HEIGHT), box(200, 0, 340, 570)], 620),
}
MISSING = ([box(0, 0, 500, HEIGHT), box(STEM, STEM, 360, 560)[::-1]], 600)
KERNING = {('T', 'O'): -60, ('O', 'T'): -60, ('P', 'O'): -20}


def glyph_bytes(contours):
    points = [p for contour in contours for p in contour]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    out = struct.pack('>hhhhh', len(contours), min(xs), min(ys), max(xs), max(ys))
    end = -1
    for contour in contours:
        end += len(contour)
        out += struct.pack('>H', end)
    out += struct.pack('>H', 0)  # no instructions
    out += bytes(p[2] for p in points)  # flags: on the curve or not; all coordinates are words
    for values in (xs, ys):
        before = 0
        for value in values:
            out += struct.pack('>h', value - before)
            before = value
    return out + b'\0' * (-len(out) % 4)


def tables():
    letters = sorted(GLYPHS)
    glyphs = [MISSING, ([], 280)] + [GLYPHS[c] for c in letters]  # .notdef, space
    index = {' ': 1, **{c: i + 2 for i, c in enumerate(letters)}}
    glyf, loca = b'', [0]
    for contours, _ in glyphs:
        glyf += glyph_bytes(contours) if contours else b''
        loca.append(len(glyf))
    every = [p for contours, _ in glyphs for contour in contours for p in contour]
    low_x, low_y = min(p[0] for p in every), min(p[1] for p in every)
    high_x, high_y = max(p[0] for p in every), max(p[1] for p in every)
    widest = max(width for _, width in glyphs)
    pairs = sorted((index[a], index[b], value) for (a, b), value in KERNING.items())
    codes = sorted((ord(c), i) for c, i in index.items())
    segments = codes + [(0xFFFF, 0)]
    count = len(segments)
    cmap = struct.pack('>HHHHHHH', 4, 16 + 8 * count, 0, 2 * count, 0, 0, 0)
    cmap += b''.join(struct.pack('>H', c) for c, _ in segments) + struct.pack('>H', 0)
    cmap += b''.join(struct.pack('>H', c) for c, _ in segments)
    cmap += b''.join(struct.pack('>H', (i - c) & 0xFFFF) if c != 0xFFFF else struct.pack('>H', 1) for c, i in segments)
    cmap += b'\0\0' * count
    kern = b''.join(struct.pack('>HHh', *pair) for pair in pairs)
    return {
        'cmap': struct.pack('>HHHHL', 0, 1, 3, 1, 12) + cmap,
        'glyf': glyf,
        'head': struct.pack('>LLLLHHQQhhhhHHhhh', 0x10000, 0x10000, 0, 0x5F0F3CF5, 0, EM, 0, 0, low_x, low_y,
                            high_x, high_y, 0, 8, 2, 1, 0),
        'hhea': struct.pack('>LhhhHhhhhhhhhhhhH', 0x10000, HEIGHT, -200, 0, widest, 0, 0, high_x, 1, 0, 0, 0, 0,
                            0, 0, 0, len(glyphs)),
        'hmtx': b''.join(struct.pack('>Hh', width, 0) for _, width in glyphs),
        'kern': struct.pack('>HHHHHHHHH', 0, 1, 0, 14 + len(kern), 1, len(pairs), 0, 0, 0) + kern,
        'loca': b''.join(struct.pack('>L', at) for at in loca),
        'maxp': struct.pack('>LHHHHHHHHHHHHHH', 0x10000, len(glyphs), 64, 8, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0),
    }


def checksum(data):
    data += b'\0' * (-len(data) % 4)
    return sum(struct.unpack(f'>{len(data) // 4}L', data)) & 0xFFFFFFFF


def font():
    parts = tables()
    for adjusted in (False, True):
        directory, body, at = b'', b'', 12 + 16 * len(parts)
        for tag in sorted(parts):
            data = parts[tag]
            plain = data[:8] + b'\0' * 4 + data[12:] if tag == 'head' else data
            directory += struct.pack('>4sLLL', tag.encode(), checksum(plain), at + len(body), len(data))
            body += data + b'\0' * (-len(data) % 4)
        whole = struct.pack('>LHHHH', 0x10000, len(parts), 128, 3, 16 * len(parts) - 128) + directory + body
        if not adjusted:
            head = parts['head']
            parts['head'] = head[:8] + struct.pack('>L', (0xB1B0AFBA - checksum(whole)) & 0xFFFFFFFF) + head[12:]
    return whole


if __name__ == '__main__':
    if len(sys.argv) != 2 or sys.argv[1].startswith('-'):
        print(__doc__.strip())
        sys.exit(0 if sys.argv[1:] in (['-h'], ['--help']) else 2)
    with open(sys.argv[1], 'wb') as out:
        out.write(font())
