#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""examples/warehouse/draw_map.py OUT: draws the map of a warehouse of 40 m x 25 m as a PGM picture.
A pixel is 10 cm. Its grey level is the material: walls 0, racks 40, panels of the cold store 60."""
import sys

CELL = 0.1  # m
WIDTH, HEIGHT = 40, 25  # m
FREE, WALL, RACK, PANEL = 254, 0, 40, 60

columns, rows = round(WIDTH / CELL), round(HEIGHT / CELL)
pixels = [bytearray([FREE]) * columns for _ in range(rows)]


def fill(x0, y0, x1, y1, grey):
    """Fills the rectangle between two corners in metres; y points up, rows go down."""
    for row in range(rows - round(y1 / CELL), rows - round(y0 / CELL)):
        for column in range(round(x0 / CELL), round(x1 / CELL)):
            pixels[row][column] = grey


def room(x0, y0, x1, y1, thickness, grey):
    """Draws the four walls of a room, inside of its corners."""
    fill(x0, y0, x1, y0 + thickness, grey)
    fill(x0, y1 - thickness, x1, y1, grey)
    fill(x0, y0, x0 + thickness, y1, grey)
    fill(x1 - thickness, y0, x1, y1, grey)


for x in (9, 12.6, 16.2, 19.8, 23.4):  # racks, with aisles of 2.4 m between them
    fill(x, 3, x + 1.2, 11.5, RACK)
    fill(x, 13.5, x + 1.2, 22, RACK)
for x in (28.2, 31.8, 35.4):
    fill(x, 3, x + 1.2, 11.5, RACK)
room(27.8, 14, 40, 25, 0.2, PANEL)  # cold store
fill(27.8, 18, 28, 21, FREE)  # its gate, open
room(0, 0, 6, 6, 0.2, WALL)  # office
fill(4, 5.8, 5, 6, FREE)  # its door, open
room(0, 0, WIDTH, HEIGHT, 0.2, WALL)

with open(sys.argv[1], "wb") as out:
    out.write(b"P5\n%d %d\n255\n" % (columns, rows) + b"".join(pixels))
