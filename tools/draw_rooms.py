#!/usr/bin/env python3
"""Draws the rooms of src/ as docs/images/rooms.svg: floors of src/LAYERS, first sentence of each card, real #includes.

usage: draw_rooms.py [--check] [SRC]      --check: compares the file with what would be drawn, writes nothing

An arrow from a room to a lower one stands for includes. It is left out where the lower room is also reached by way of
another arrow: core stands below everything, and most arrows to it would only repeat what others say. Exit code of
--check: 1 if the picture is not up to date.
"""
import pathlib
import sys
import textwrap
from html import escape

import check_layers

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURE = ROOT / "docs/images/rooms.svg"
WIDTH, MARGIN = 980, 24
GAP_X, GAP_Y, GAP_LANE = 22, 40, 12  # between boxes of a floor, between floors, beside an arrow that passes a floor
LANE = 10  # width that an arrow takes where it passes a floor
LINE, TITLE = 15, 20  # heights of a line of text and of a room's name
BOX = {1: (470, 72), 2: (320, 50), 3: (255, 37), 4: (216, 31)}  # rooms on a floor: width, characters a line
STYLE = """
  .paper { fill: #ffffff }
  .room { fill: #eef3f8; stroke: #4a6785; stroke-width: 1.2 }
  .name { font: 600 15px "DejaVu Sans", Verdana, sans-serif; fill: #1d2b3a }
  .text { font: 11.5px "DejaVu Sans", Verdana, sans-serif; fill: #33475b }
  .arrow { fill: none; stroke: #7b8794; stroke-width: 1.3 }
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


def include_graph(src, levels):
    """Room -> the rooms it includes."""
    return {
        room: {target.split("/")[0] for _, _, target in check_layers.includes(src / room)} & set(levels) - {room}
        for room in levels
    }


def reachable(graph, room):
    found = set(graph[room])
    for other in graph[room]:
        found |= reachable(graph, other)
    return found


def without_detours(graph):
    """Arrows (upper, lower) that no way over other rooms replaces."""
    return sorted(
        (room, low)
        for room, lows in graph.items()
        for low in lows
        if not any(low in reachable(graph, other) for other in lows - {low})
    )


def split_arrows(arrows, levels):
    """Floors with the rooms and the points where arrows pass them; pieces of arrows from floor to floor."""
    floors = [[] for _ in range(max(levels.values()) + 1)]
    for room, level in levels.items():
        floors[level].append(room)
    pieces = []
    for upper, lower in arrows:
        here = lower
        for level in range(levels[lower] + 1, levels[upper]):
            floors[level].append((lower, upper, level))
            pieces.append((here, floors[level][-1]))
            here = floors[level][-1]
        pieces.append((here, upper))
    return floors, pieces


def crossings(pieces, order):
    ends = [(order[low], order[high]) for low, high in pieces]
    return sum((a - c) * (b - d) < 0 for k, (a, b) in enumerate(ends) for c, d in ends[:k])


def arrange(floors, pieces):
    """Orders each floor so that few arrows cross: means of the neighbours' places, then swaps while they help."""
    below = {}
    above = {}
    for low, high in pieces:
        below.setdefault(high, []).append(low)
        above.setdefault(low, []).append(high)
    for sweep in range(12):
        side, run = (below, range(1, len(floors))) if sweep % 2 == 0 else (above, range(len(floors) - 2, -1, -1))
        for level in run:
            near = floors[level - 1] if side is below else floors[level + 1]
            at = {item: (k + 0.5) / len(near) for k, item in enumerate(near)}
            mean = {item: sum(at[n] for n in side.get(item, [])) / len(side.get(item, [0])) for item in floors[level]}
            floors[level].sort(key=mean.get)
    improved = True
    while improved:
        improved = False
        for level, floor in enumerate(floors):
            for k in range(len(floor) - 1):
                before = total_crossings(floors, pieces)
                floor[k], floor[k + 1] = floor[k + 1], floor[k]
                if total_crossings(floors, pieces) < before:
                    improved = True
                else:
                    floor[k], floor[k + 1] = floor[k + 1], floor[k]
    return floors


def total_crossings(floors, pieces):
    level_of = {item: level for level, floor in enumerate(floors) for item in floor}
    order = {item: k for floor in floors for k, item in enumerate(floor)}
    return sum(crossings([p for p in pieces if level_of[p[0]] == level], order) for level in range(len(floors)))


def box_of(floor):
    """Width of a floor's boxes and of their text, in characters: wide where nothing else stands on the floor."""
    rooms = sum(isinstance(other, str) for other in floor)
    return BOX[min(max(rooms, 2 if len(floor) > 1 else 1), 4)]


def width_of(item, floor):
    return box_of(floor)[0] if isinstance(item, str) else LANE


def place(floors, pieces):
    """Middles in x: as near to those of the neighbours as the boxes allow, long arrows straight."""
    near = {}
    for low, high in pieces:
        weight = (1, 2, 8)[(not isinstance(low, str)) + (not isinstance(high, str))]
        near.setdefault(low, []).append((high, weight))
        near.setdefault(high, []).append((low, weight))
    x = {item: WIDTH * (k + 0.5) / len(floor) for floor in floors for k, item in enumerate(floor)}
    for sweep in range(200):
        for floor in floors if sweep % 2 else reversed(floors):
            weights = [sum(w for _, w in near[item]) for item in floor]
            wish = [sum(w * x[n] for n, w in near[item]) / total for item, total in zip(floor, weights)]
            if len(floor) == 1:
                wish = [WIDTH / 2]
            for item, at in zip(floor, apart(floor, wish, weights)):
                x[item] = at
    return x


def apart(floor, wish, weights):
    """Places in the order of the floor that do not overlap and are nearest to the wanted ones in the squared mean."""
    widths = [width_of(item, floor) for item in floor]
    offset = [0.0]
    for w, v in zip(widths, widths[1:]):
        offset.append(offset[-1] + (w + v) / 2 + (GAP_X if LANE not in (w, v) else GAP_LANE))
    groups = []  # of neighbours that touch: sum of weights, mean, members
    for want, weight, off in zip(wish, weights, offset):
        groups.append([weight, want - off, 1])
        while len(groups) > 1 and groups[-2][1] > groups[-1][1]:
            weight, mean, count = groups.pop()
            total = groups[-1][0] + weight
            groups[-1] = [total, (groups[-1][0] * groups[-1][1] + weight * mean) / total, groups[-1][2] + count]
    least, most = MARGIN + widths[0] / 2, WIDTH - MARGIN - widths[-1] / 2 - offset[-1]
    shifts = [min(max(mean, least), most) for _, mean, count in groups for _ in range(count)]
    return [shift + off for shift, off in zip(shifts, offset)]


def draw(src):
    levels = check_layers.read_layers((src / "LAYERS").read_text())
    arrows = without_detours(include_graph(src, levels))
    floors, pieces = split_arrows(arrows, levels)
    floors = arrange(floors, pieces)
    x = place(floors, pieces)
    texts = {}
    for floor in floors:
        rooms = [item for item in floor if isinstance(item, str)]
        for room in rooms:
            texts[room] = textwrap.wrap(sentence(src / room / "README.md"), box_of(floor)[1], break_on_hyphens=False)
    heights = [TITLE + 14 + LINE * max(len(texts[r]) for r in floor if isinstance(r, str)) for floor in floors]
    top, y = {}, MARGIN
    for level in range(len(floors) - 1, -1, -1):
        top[level] = y
        y += heights[level] + GAP_Y
    height = y - GAP_Y + MARGIN
    level_of = {item: level for level, floor in enumerate(floors) for item in floor}
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}">',
        "<title>The rooms of src/, and which includes which</title>",
        "<!-- Written by tools/draw_rooms.py; a test compares it with src/LAYERS, the cards and the #includes. -->",
        f"<style>{STYLE}</style>",
        '<defs><marker id="tip" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0,1 L10,5 L0,9 z" fill="#7b8794"/></marker></defs>',
        f'<rect class="paper" width="{WIDTH}" height="{height}" rx="8"/>',
    ]
    out += [arrow(a, floors, pieces, x, top, heights, level_of) for a in arrows]
    for room in levels:
        out += box(room, floors[levels[room]], x[room], top[levels[room]], heights[levels[room]], texts[room])
    return "\n".join(out + ["</svg>", ""])


def arrow(ends, floors, pieces, x, top, heights, level_of):
    """A smooth line from the upper room down to the lower one, straight where it passes a floor."""
    upper, lower = ends
    way = [upper] + [(lower, upper, level) for level in range(level_of[upper] - 1, level_of[lower], -1)] + [lower]
    here, y = port(upper, way[1], floors, pieces, x), top[level_of[upper]] + heights[level_of[upper]]
    path = f"M{here:.1f},{y}"
    for item in way[1:]:
        level = level_of[item]
        there = x[item] if item != lower else port(lower, way[-2], floors, pieces, x)
        end = top[level]
        path += f" C{here:.1f},{y + GAP_Y * 0.6:.1f} {there:.1f},{end - GAP_Y * 0.6:.1f} {there:.1f},{end}"
        here, y = there, end
        if item != lower:
            y = end + heights[level]
            path += f" L{here:.1f},{y}"
    return f'<path class="arrow" marker-end="url(#tip)" d="{path}"/>'


def port(room, other, floors, pieces, x):
    """Where an arrow meets a box: the arrows of one side stand apart, in the order of their other ends."""
    level_of = {item: level for level, floor in enumerate(floors) for item in floor}
    side = level_of[other] > level_of[room]
    mates = [high if low == room else low for low, high in pieces if room in (low, high)]
    mates = sorted((m for m in mates if (level_of[m] > level_of[room]) == side), key=lambda m: x[m])
    width = width_of(room, floors[level_of[room]])
    step = min(36, (width - 30) / max(len(mates), 1))
    return x[room] + (mates.index(other) - (len(mates) - 1) / 2) * step


def box(room, floor, x, y, height, lines):
    width = width_of(room, floor)
    out = [f'<rect class="room" x="{x - width / 2:.1f}" y="{y}" width="{width}" height="{height}" rx="6"/>']
    out.append(f'<text class="name" x="{x:.1f}" y="{y + TITLE}" text-anchor="middle">{escape(room)}</text>')
    for k, line in enumerate(lines):
        at = y + TITLE + 4 + LINE * (k + 1)
        out.append(f'<text class="text" x="{x:.1f}" y="{at}" text-anchor="middle">{escape(line)}</text>')
    return out


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
