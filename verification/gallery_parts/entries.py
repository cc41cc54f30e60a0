"""The gallery: which scenes it shows, in which settings they run, and which pictures are drawn of them."""

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Run:
    """A scene with keys changed on the way."""

    scene: str
    settings: Sequence[str] = ()


@dataclass(frozen=True)
class Still:
    """A picture of figures.py, of one run or two side by side; `drawn` is the name of its file there."""

    image: str
    picture: str
    drawn: str
    runs: Sequence[str]


@dataclass(frozen=True)
class Film:
    """A moving picture of animate.py."""

    image: str
    run: str
    options: Sequence[str] = ()


@dataclass(frozen=True)
class Entry:
    """One section of docs/gallery.md, under the name of its scene."""

    scene: str
    runs: dict[str, Run]
    pictures: Sequence[Still | Film] = field(default_factory=tuple)

    @property
    def moves(self) -> bool:
        return any(isinstance(picture, Film) for picture in self.pictures)


FOUNDATION = "boundary.bottom.contact.conductance.foundation_temperature"


def cold_and_hot(scene: str) -> dict[str, Run]:
    return {
        f"{name}": Run(scene, (f"{FOUNDATION}={theta}",)) for name, theta in (("cold", 0.0), ("hot", 10.0))
    }


BOTH = ("cold", "hot")
ENTRIES = (
    Entry(
        "paper",
        cold_and_hot("paper"),
        (
            Still("deformed.png", "deformed", "deformed.png", BOTH),
            Still("temperature.png", "temperature", "temperature.png", BOTH),
            Still("contact-bottom-final.png", "contact-final", "contact-bottom-final.png", BOTH),
        ),
    ),
    Entry(
        "paper-isotropic",
        cold_and_hot("paper-isotropic"),
        (Still("isotropic-temperature.png", "temperature", "temperature.png", BOTH),),
    ),
    Entry(
        "impact",
        {"impact": Run("impact", ("time.steps=128", "output.every=2"))},
        (Film("impact.gif", "impact", ("--frames", "18", "--dpi", "64")),),
    ),
    Entry(
        "stick-slip",
        {"stick-slip": Run("stick-slip")},
        (
            Film(
                "stick-slip.gif",
                "stick-slip",
                ("--field", "velocity", "--frames", "24", "--from", "0.3", "--until", "0.8"),
            ),
            Still("stick-slip.png", "spring-history", "spring-history.png", ("stick-slip",)),
        ),
    ),
    Entry(
        "disc-brake",
        {"disc-brake": Run("disc-brake", ("output.every=1",))},
        (
            Film("disc-brake.gif", "disc-brake", ("--frames", "20")),
            Still("disc-brake.png", "temperature", "temperature.png", ("disc-brake",)),
        ),
    ),
    Entry(
        "press-fit",
        {"press-fit": Run("press-fit")},
        (
            Still("press-fit-deformed.png", "deformed", "deformed.png", ("press-fit",)),
            Still("press-fit-von-mises.png", "von-mises", "von-mises.png", ("press-fit",)),
        ),
    ),
    Entry(
        "sphere",
        {"sphere": Run("sphere")},
        (Still("sphere.png", "temperature", "temperature.png", ("sphere",)),),
    ),
    Entry(
        "seal", {"seal": Run("seal")}, (Film("seal.gif", "seal", ("--field", "von_mises", "--frames", "24")),)
    ),
)
