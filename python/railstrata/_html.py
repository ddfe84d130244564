"""What notebooks show of a result: a table and a picture, no script."""
from __future__ import annotations

import base64
import html
import struct
import zlib
from collections.abc import Iterable

import numpy as np

from ._bridge import Array

from .patch import Patch

# Colours of the pressure, low to high: steps of viridis.
_COLOURS = np.array([(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)], float)


def _png(pixels: Array) -> bytes:
    """An RGBA picture (rows, columns, 4) of bytes as a PNG file."""
    rows, columns = pixels.shape[:2]

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + pixels[row].tobytes() for row in range(rows))
    header = struct.pack(">IIBBBBB", columns, rows, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


def _pressure_pixels(p: Array) -> Array:
    """Rolling direction to the right, y upwards; separated points are transparent."""
    share = p / p.max() if p.max() > 0 else p
    place = np.linspace(0, 1, len(_COLOURS))
    rgb = np.stack([np.interp(share, place, _COLOURS[:, k]) for k in range(3)], axis=-1)
    alpha = np.where(p > 0, 255, 0)[..., None]
    pixels: Array = np.concatenate([rgb, alpha], axis=-1).round().astype(np.uint8).transpose(1, 0, 2)[::-1]
    return pixels


def patch_figure(patch: Patch) -> str:
    """A picture of the pressure; empty for a line contact."""
    if patch.shape[1] < 2 or patch.shape[0] < 2:
        return ""
    x, y = 1e3 * patch.x, 1e3 * patch.y
    width, height = float(np.ptp(x)), float(np.ptp(y))
    data = base64.b64encode(_png(_pressure_pixels(patch.p))).decode()
    w, h = 260, max(40, min(400, round(260 * height / width)))
    return (
        f'<svg width="{w + 40}" height="{h + 40}" xmlns="http://www.w3.org/2000/svg" font-size="11">'
        f'<image x="20" y="5" width="{w}" height="{h}" preserveAspectRatio="none" style="image-rendering:pixelated" '
        f'href="data:image/png;base64,{data}"/>'
        f'<rect x="20" y="5" width="{w}" height="{h}" fill="none" stroke="#888"/>'
        f'<text x="20" y="{h + 20}">pressure on {width:.1f} mm × {height:.1f} mm, rolling →</text></svg>'
    )


def result_html(
    heading: tuple[str, str],
    rows: Iterable[tuple[str, str]],
    checks: Iterable[tuple[str, bool]],
    notes: Iterable[str],
    figure: str,
) -> str:
    """A table of numbers and checks beside a picture; heading: title and engine."""
    numbers = "".join(f"<tr><th>{name}</th><td>{html.escape(text)}</td></tr>" for name, text in rows)
    verdicts = "".join(
        f'<tr><th>{html.escape(name)}</th><td style="color:{"#187a2f" if ok else "#b00020"}">'
        f'{"holds" if ok else "fails"}</td></tr>'
        for name, ok in checks
    )
    said = "".join(f"<p>{html.escape(text)}</p>" for text in notes)
    title, engine = heading
    return (
        f"<div><b>{html.escape(title)}</b> ({engine})"
        f'<div style="display:flex;gap:1em;flex-wrap:wrap"><table>{numbers}{verdicts}</table>{figure}</div>'
        f"{said}</div>"
    )
