"""One look for all pictures, and the writing of them."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
from PIL import Image

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  the backend comes first

from plotting.results import Results  # noqa: E402

# Blue and vermilion of Okabe and Ito: told apart with every kind of colour vision; the dashes serve in grey.
CURVES = ({"color": "#0072B2", "linestyle": "-"}, {"color": "#D55E00", "linestyle": "--"})
OPEN_COLOUR = "#bdbdbd"
PANEL = 4.3  # inches, the width of one panel
FULL_DPI, SMALL_DPI = 200, 84
SMALL_BYTES = 110_000  # a small picture with more is reduced to a palette

PARAMETERS = {
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.h_pad": 0.09,
    "figure.constrained_layout.w_pad": 0.09,
    "font.size": 10.0,
    "axes.titlesize": 10.0,
    "axes.grid": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.limits": (-3, 4),
    "axes.formatter.use_mathtext": True,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "pdf.fonttype": 42,
    "savefig.facecolor": "white",
}


@dataclass(frozen=True)
class Case:
    """One results folder and how the pictures name it."""

    label: str
    results: Results


def cases(folders: Sequence[Results]) -> list[Case]:
    """Named by foundation temperature; by folder where that does not tell them apart."""
    temperatures = [folder.foundation_temperature for folder in folders]
    if None in temperatures or len(set(temperatures)) < len(folders):
        return [Case(folder.directory.name, folder) for folder in folders]
    return [
        Case(rf"$\theta_F$ = {temperature} K", folder) for temperature, folder in zip(temperatures, folders)
    ]


class Album:
    """Where pictures go: each as PNG and PDF, or as one small PNG."""

    def __init__(self, directory: Path, small: bool) -> None:
        self.directory, self.small = directory, small
        self.written: list[Path] = []

    def save(self, figure: Any, name: str) -> None:
        self.directory.mkdir(parents=True, exist_ok=True)
        move_powers_of_ten(figure)
        png = self.directory / f"{name}.png"
        figure.savefig(png, dpi=SMALL_DPI if self.small else FULL_DPI)
        self.written.append(png)
        if self.small and png.stat().st_size > SMALL_BYTES:
            reduce_colours(png)
        if not self.small:
            figure.savefig(png.with_suffix(".pdf"), dpi=FULL_DPI)
            self.written.append(png.with_suffix(".pdf"))
        plt.close(figure)


def reduce_colours(png: Path) -> None:
    with Image.open(png) as image:
        reduced = image.convert("RGB").quantize(256)
    reduced.save(png, optimize=True)


def move_powers_of_ten(figure: Any) -> None:
    """From above the axis, where they meet the title, to the unit in the label: (m) becomes (10^-4 m)."""
    figure.canvas.draw()
    for axes in figure.axes:
        power = axes.yaxis.get_offset_text()
        label = axes.get_ylabel()
        if power.get_text() and label.endswith(")"):
            quantity, unit = label.rsplit("(", 1)
            axes.set_ylabel(f"{quantity}({power.get_text()} {unit}")
            power.set_visible(False)


@contextmanager
def styled() -> Iterator[None]:
    with matplotlib.rc_context(PARAMETERS):
        yield


def panels(rows: int, columns: int, width: float, height: float, **options: Any) -> tuple[Any, Any]:
    """A figure and its axes as a two-dimensional array; width and height of one panel in inches."""
    made: tuple[Any, Any] = plt.subplots(
        rows, columns, figsize=(columns * width, rows * height), squeeze=False, **options
    )
    return made


Draw = Callable[[Sequence[Case], Album], None]
