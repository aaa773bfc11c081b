"""Writes fir.ply, the tree of scenes/instances.pbrt: a trunk and five cones, each with a closed base."""
import math
import struct

SIDES = 11
positions, triangles = [], []


def ring(radius, height, turn):
    first = len(positions)
    for i in range(SIDES):
        angle = 2 * math.pi * (i + turn) / SIDES
        ripple = 1 + 0.16 * (1 if i % 2 else -1)
        positions.append((radius * ripple * math.cos(angle), height, radius * ripple * math.sin(angle)))
    return first


def point(height):
    positions.append((0, height, 0))
    return len(positions) - 1


def cone(radius, base, tip, turn):
    rim, top, middle = ring(radius, base, turn), point(tip), point(base + 0.25 * (tip - base))
    for i in range(SIDES):
        j = (i + 1) % SIDES
        triangles.append((rim + i, top, rim + j))
        triangles.append((rim + i, rim + j, middle))


for level in range(5):
    cone(0.42 - 0.07 * level, 0.25 + 0.3 * level, 0.8 + 0.3 * level, 0.37 * level)
cone(0.06, 0, 0.6, 0)

with open("fir.ply", "wb") as out:
    out.write(("ply\nformat binary_little_endian 1.0\ncomment made by fir.py\n"
               f"element vertex {len(positions)}\nproperty float x\nproperty float y\nproperty float z\n"
               f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
    for p in positions:
        out.write(struct.pack("<3f", *p))
    for t in triangles:
        out.write(struct.pack("<B3i", 3, *t))
