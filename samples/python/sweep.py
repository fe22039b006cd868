"""Sweeps one parameter over 100 pots: how much does a wall cost? Run it with a built package:

    PYTHONPATH=build/release/python python3 samples/python/sweep.py sweep.csv sweep.svg

For walls from 2 to 8 mm, stacks a cup, exports its solid in memory and weighs it. Writes a table,
and a plot of weight against wall as SVG. The plot needs no library.
"""

import math
import sys

import claystack

POTS = 100
RINGS, RING_HEIGHT_MM, FLOOR_MM = 200, 0.5, 6.0


# %% A cup: the outside is a soft S, the inside follows it at a distance.
def cup(wall_mm: float) -> claystack.Pot:
    outer, inner = [], []
    for ring in range(RINGS):
        height = (ring + 0.5) * RING_HEIGHT_MM
        radius = 36.0 + 8.0 * math.sin(0.03 * height)
        outer.append(radius)
        inner.append(radius - wall_mm if height > FLOOR_MM else 0.0)
    return claystack.stack(RING_HEIGHT_MM, outer, inner)


# %% Each pot as a solid: its weight from the mesh, not from the rings.
def weight_g(pot: claystack.Pot) -> float:
    verdict = claystack.check(claystack.mesh(pot, tolerance_mm=0.05))
    assert verdict.sound, verdict.problems
    return 1e-3 * verdict.volume_mm3 * pot.density_g_cm3


def sweep() -> list:
    walls = [2.0 + 6.0 * i / (POTS - 1) for i in range(POTS)]
    return [(wall, weight_g(cup(wall))) for wall in walls]


# %% The plot.
def svg(rows: list) -> str:
    width, height, margin = 480, 320, 48
    most_g = 100.0 * math.ceil(max(weight for _, weight in rows) / 100.0)

    def place(wall: float, weight: float) -> str:
        x = margin + (wall - 2.0) / 6.0 * (width - 2 * margin)
        y = height - margin - weight / most_g * (height - 2 * margin)
        return f"{x:.1f},{y:.1f}"

    corner, right, top = place(2, 0).split(","), place(8, 0).split(","), place(2, most_g).split(",")
    line = " ".join(place(*row) for row in rows)
    marks = ""
    for wall in range(2, 9):
        x, y = place(wall, 0).split(",")
        marks += f'<text x="{x}" y="{float(y) + 16}" text-anchor="middle">{wall}</text>\n'
    for weight in range(0, int(most_g) + 1, 100):
        x, y = place(2, weight).split(",")
        marks += f'<path d="M{x} {y}H{right[0]}" stroke="#ddd"/>\n'
        marks += f'<text x="{float(x) - 6}" y="{float(y) + 4}" text-anchor="end">{weight}</text>\n'
    return f"""<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"
 font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="white"/>
{marks}<path d="M{top[0]} {top[1]}V{corner[1]}H{right[0]}" fill="none" stroke="#444"/>
<polyline points="{line}" fill="none" stroke="#b4552d" stroke-width="2"/>
<text x="{width / 2}" y="{height - 12}" text-anchor="middle">Wall [mm]</text>
<text x="{margin}" y="{margin - 12}">Weight [g]</text>
</svg>
"""


def main() -> None:
    table, plot = (sys.argv[1:] + ["sweep.csv", "sweep.svg"])[:2]
    rows = sweep()
    with open(table, "w", encoding="utf-8") as file:
        file.write("wall_mm,weight_g\n")
        file.writelines(f"{wall:.3f},{weight:.2f}\n" for wall, weight in rows)
    with open(plot, "w", encoding="utf-8") as file:
        file.write(svg(rows))
    print(f"{POTS} pots: {rows[0][1]:.0f} g with 2 mm, {rows[-1][1]:.0f} g with 8 mm")


if __name__ == "__main__":
    main()
