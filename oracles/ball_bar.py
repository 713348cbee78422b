"""A ball-bar export made for this project: a circle from the definitions of its causes, never from the Rust code.

Run in the repository root: python3 oracles/ball_bar.py
Writes examples/07_verify/ball-bar-export.csv: German words, `;`, decimal commas, Windows-1252, two blocks.
No real machine and the form of no instrument; seed 20261124. The causes, which `evaluate` must find:

    squareness XY, closer than 90 deg   31 urad         backlash X, Y        -2.4 um, -1.5 um
    scale mismatch X - Y                6 um            lateral play X       1.2 um
    servo mismatch                      3 um            straightness X       4 um
    reversal spikes Y                   2.5 um          noise                0.25 um
"""

import numpy as np

RADIUS = 150.0  # mm
CAUSES = dict(square=31e-6, scale=6e-3, servo=3e-3, back=(-2.4e-3, -1.5e-3), play=1.2e-3, bow=4e-3)
CENTRE = (0.004, -0.007)


def radial(angle, sense):
    """mm; sense +1 counter-clockwise, -1 clockwise."""
    c, s = np.cos(angle), np.sin(angle)
    vx, vy = np.sign(-sense * s), np.sign(sense * c)
    r = CENTRE[0] * c + CENTRE[1] * s
    # Axes closer than 90 deg by gamma: the diagonal at 45 deg is longer by R gamma/2.
    r += 0.5 * CAUSES["square"] * RADIUS * np.sin(2 * angle)
    # X longer than Y by the mismatch over the diameter: a quarter of it to either radius.
    r += 0.25 * CAUSES["scale"] * np.cos(2 * angle)
    r += 0.5 * CAUSES["servo"] * sense * np.sin(2 * angle)
    r += 0.5 * CAUSES["back"][0] * vx * c + 0.5 * CAUSES["back"][1] * vy * s
    r += 0.5 * CAUSES["play"] * vx * s
    r += CAUSES["bow"] * c * c * s
    # Y sticks for four degrees after it has reversed at 90 and 270 deg.
    after = np.mod(sense * angle - np.pi / 2, np.pi)
    r += np.where(after < np.radians(4), 2.5e-3, 0.0)
    return r


def main():
    random = np.random.default_rng(20261124)
    with open("examples/07_verify/ball-bar-export.csv", "w", encoding="cp1252", newline="") as out:
        line = lambda *cells: out.write(";".join(cells) + "\r\n")
        line("Kreisformtest", "Prüfling: Fräsmaschine 3 (erfunden)")
        line("Datum", "24.11.2026")
        line("Halbmesser", "150,000", "mm")
        for title, sense in [("Lauf 1 gegen den Uhrzeigersinn", 1), ("Lauf 2 im Uhrzeigersinn", -1)]:
            out.write("\r\n" + title + "\r\n")
            line("Nr.", "Winkel", "Abweichung")
            line("", "°", "mm")
            for k in range(721):
                degrees = 0.5 * k if sense > 0 else 360 - 0.5 * k
                value = radial(np.radians(degrees) + sense * 1e-9, sense) + random.normal(0, 0.25e-3)
                line(str(k + 1), f"{degrees:.1f}".replace(".", ","), f"{value:.5f}".replace(".", ","))


if __name__ == "__main__":
    main()
