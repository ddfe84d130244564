#!/usr/bin/env python3
"""Draws the house as docs/images/rooms.svg: the wings of src/LAYERS from top to bottom, in each its rooms by floors
with the first sentence of their cards.

usage: draw_rooms.py [--check] [SRC]      --check: compares the file with what would be drawn, writes nothing

Exit code of --check: 1 if the picture is not up to date.
"""
import pathlib
import sys
import textwrap
from html import escape

import check_layers

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs/images/rooms.svg"
WIDTH, MARGIN, PAD, GAP = 980, 24, 12, 14
NAME_WIDTH = 96  # left of the rooms: the wing's name
LINE, TITLE = 15, 20  # heights of a line of text and of a room's name
ACROSS = 4  # rooms side by side
PIXELS_PER_LETTER = 6.4
STYLE = """
  .paper { fill: #ffffff }
  .wing { fill: #eef3f8; stroke: #4a6785; stroke-width: 1.2 }
  .room { fill: #ffffff; stroke: #9fb2c6 }
  .wing-name { font: 700 17px "DejaVu Sans", Verdana, sans-serif; fill: #1d2b3a }
  .name { font: 600 14px "DejaVu Sans", Verdana, sans-serif; fill: #1d2b3a }
  .text { font: 11px "DejaVu Sans", Verdana, sans-serif; fill: #33475b }
"""


def sentence(card):
    """The first sentence below the card's heading."""
    lines = []
    for line in card.read_text().splitlines()[1:]:
        if line.strip():
            lines.append(line.strip())
        elif lines:
            break
    return " ".join(lines).replace("`", "")


def rows_of(floors):
    """Rows of rooms from top to bottom: the highest floor first, at most ACROSS rooms in a row."""
    return [floor[k:k + ACROSS] for floor in reversed(floors) for k in range(0, len(floor), ACROSS)]


def draw_row(rooms, folders, y):
    """The boxes of a row of rooms and its height."""
    inside = WIDTH - 2 * MARGIN - NAME_WIDTH - PAD
    width = (inside - GAP * (len(rooms) - 1)) / len(rooms)
    letters = int((width - 2 * PAD) / PIXELS_PER_LETTER)
    texts = [textwrap.wrap(sentence(folders[room] / "README.md"), letters, break_on_hyphens=False) for room in rooms]
    height = TITLE + LINE * max(map(len, texts)) + PAD
    out = []
    for k, (room, lines) in enumerate(zip(rooms, texts)):
        x = MARGIN + NAME_WIDTH + k * (width + GAP)
        out.append(f'<rect class="room" x="{x:.1f}" y="{y}" width="{width:.1f}" height="{height}" rx="5"/>')
        out.append(f'<text class="name" x="{x + PAD:.1f}" y="{y + TITLE}">{escape(room)}</text>')
        out += [f'<text class="text" x="{x + PAD:.1f}" y="{y + TITLE + LINE * (n + 1)}">{escape(line)}</text>'
                for n, line in enumerate(lines)]
    return out, height


def draw_wing(wing, floors, folders, top):
    """The box of a wing with its rooms, and its height."""
    y, inside = top + PAD, []
    for rooms in rows_of(floors):
        boxes, height = draw_row(rooms, folders, y)
        inside += boxes
        y += height + PAD
    box = (f'<rect class="wing" x="{MARGIN}" y="{top}" width="{WIDTH - 2 * MARGIN}" height="{y - top}" rx="8"/>'
           f'<text class="wing-name" x="{MARGIN + PAD}" y="{(top + y) / 2 + 6:.0f}">{escape(wing)}</text>')
    return [box, *inside], y - top


def draw(src):
    wings = check_layers.read_wings((src / "LAYERS").read_text())
    folders = check_layers.room_folders(src)
    body, y = [], MARGIN
    for wing, floors in reversed(wings.items()):
        boxes, height = draw_wing(wing, floors, folders, y)
        body += boxes
        y += height + GAP
    height = y - GAP + MARGIN
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}">',
        "<title>The wings of src/ and their rooms</title>",
        "<!-- Written by tools/draw_rooms.py; a test compares it with src/LAYERS and the cards. -->",
        f"<style>{STYLE}</style>",
        f'<rect class="paper" width="{WIDTH}" height="{height}" rx="8"/>',
        *body,
        "</svg>",
        "",
    ])


def main():
    words = [w for w in sys.argv[1:] if w != "--check"]
    drawn = draw(pathlib.Path(words[0]) if words else ROOT / "src")
    if "--check" not in sys.argv[1:]:
        PICTURE.write_text(drawn)
        return 0
    if PICTURE.exists() and PICTURE.read_text() == drawn:
        print(f"{PICTURE.name} shows the rooms as they are")
        return 0
    print(f"{PICTURE}: not up to date; write it anew by tools/draw_rooms.py")
    return 1


if __name__ == "__main__":
    sys.exit(main())
